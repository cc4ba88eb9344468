// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_text_h
#define ebsmpm_base_text_h

#include <ebsmpm/base/config.h>

#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * What messages are put together from. A message is one sentence in one line;
   * what it takes from a user, the value of a parameter for example, is quoted.
   */
  namespace Text
  {
    /**
     * Return @p text between single quotes.
     */
    std::string
    quote(const std::string &text);

    /**
     * Replace all white space, ends of lines included, by single blanks.
     */
    std::string
    in_one_line(const std::string &text);

    /**
     * Return whether the last letters of @p text are @p end.
     */
    bool
    ends_with(const std::string &text, const std::string &end);

    /**
     * Return "a, b and c", with @p last_word for "and".
     */
    std::string
    enumerate(const std::vector<std::string> &items,
              const std::string              &last_word);

    /**
     * End a sentence with a full stop, unless it has an end.
     */
    std::string
    finish(std::string sentence);
  } // namespace Text
} // namespace EBSMPM

#endif
