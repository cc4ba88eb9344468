// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_parameter_values_h
#define ebsmpm_base_parameter_values_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <map>
#include <string>

namespace EBSMPM
{
  /**
   * The values of all parameters as text, by their full names,
   * <tt>Section/Name</tt>.
   */
  using ParameterValues = std::map<std::string, std::string>;

  /**
   * Return the values that @p prm has now, for instance to store them with
   * results, and to compare them with those of another run by
   * require_same_parameters(). Aliases are left out.
   */
  ParameterValues
  parameter_values(const ParameterHandler &prm);

  /**
   * Throw ExcParameter, which names the parameter and both values, for the
   * first one in @p values whose value in @p required is another, unless
   * @p may_differ says that this does not matter. Parameters that only one of
   * the two knows are not compared: a newer version of the program may have
   * more of them.
   *
   * @param reason the end of the sentence "must be 'value'", such as "as in the
   *   earlier run"
   */
  void
  require_same_parameters(
    const ParameterValues                          &values,
    const ParameterValues                          &required,
    const std::function<bool(const std::string &)> &may_differ,
    const std::string                              &reason);
} // namespace EBSMPM

#endif
