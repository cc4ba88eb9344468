// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_splines_verdict_h
#define ebsmpm_tests_splines_verdict_h

// How tests print numbers: with few digits, or as the answer to the question
// whether they are small enough, so that all machines print the same.

#include <cstdio>
#include <string>



/** A number with few digits. */
inline std::string
digits(const double x, const unsigned int n = 6)
{
  char buffer[40];
  std::snprintf(buffer, sizeof(buffer), "%.*e", static_cast<int>(n) - 1, x);
  return buffer;
}



/** The answer to a question, with the evidence if it is not the wanted one. */
inline std::string
verdict(const double error, const double bound)
{
  return error <= bound ? "OK" : "FAILED, " + digits(error, 3);
}

#endif
