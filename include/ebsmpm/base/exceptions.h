// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_exceptions_h
#define ebsmpm_base_exceptions_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/exceptions.h>

#include <string>

namespace EBSMPM
{
  /**
   * The errors a user of the library can cause or meet, one class for each
   * thing that a program may want to react to. All are raised by AssertThrow,
   * hence also in release mode. Mistakes of the programmer are caught by Assert
   * with deal.II's own exceptions instead.
   */

  /**
   * A run-time parameter has a value that is not allowed. The arguments are the
   * full name of the parameter ("Section/Name"), the value found, and the
   * values allowed.
   */
  DeclException3(ExcParameter,
                 std::string,
                 std::string,
                 std::string,
                 << "The parameter '" << arg1 << "' is '" << arg2
                 << "', but must be " << arg3 << ".");

  /**
   * A parameter file, or an option on the command line, cannot be understood.
   * The argument is one sentence that says which, and what to do.
   */
  DeclException1(ExcInput, std::string, << arg1);

  /**
   * A file cannot be read or written, or already exists and must not be
   * overwritten.
   */
  DeclException2(ExcFile,
                 std::string,
                 std::string,
                 << "The file '" << arg1 << "' " << arg2 << ".");

  /**
   * A material or boundary point is outside of the background grid.
   */
  DeclException2(ExcPointOutsideGrid,
                 std::string,
                 std::string,
                 << "A point at (" << arg1
                 << ") is outside of the background grid " << arg2
                 << ". Enlarge the grid, so that the body stays inside while "
                 << "it moves.");

  /**
   * A linear or nonlinear solve failed; the argument says how. The load
   * stepping catches this exception and cuts the increment back.
   */
  DeclException1(ExcSolverFailure, std::string, << arg1);

  /**
   * The increment was cut back as far as allowed and the step still fails. The
   * arguments are the step, the smallest increment tried, and the last failure.
   */
  DeclException3(ExcStepFailure,
                 unsigned int,
                 double,
                 std::string,
                 << "Load step " << arg1
                 << " fails even with the smallest increment " << arg2 << ": "
                 << arg3);
} // namespace EBSMPM

#endif
