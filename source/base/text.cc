// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/text.h>

#include <cctype>
#include <sstream>

namespace EBSMPM
{
  namespace Text
  {
    std::string
    quote(const std::string &text)
    {
      return "'" + text + "'";
    }



    std::string
    in_one_line(const std::string &text)
    {
      std::istringstream words(text);
      std::string        line;
      for (std::string word; words >> word;)
        line += (line.empty() ? "" : " ") + word;
      return line;
    }



    bool
    ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() &&
             text.compare(text.size() - end.size(), end.size(), end) == 0;
    }



    std::string
    enumerate(const std::vector<std::string> &items,
              const std::string              &last_word)
    {
      std::string text;
      for (unsigned int i = 0; i < items.size(); ++i)
        {
          if (i > 0)
            text += (i + 1 == items.size()) ? " " + last_word + " " : ", ";
          text += items[i];
        }
      return text;
    }



    std::string
    finish(std::string sentence)
    {
      while (!sentence.empty() &&
             std::isspace(static_cast<unsigned char>(sentence.back())))
        sentence.pop_back();
      if (!sentence.empty() &&
          std::string(".?!").find(sentence.back()) == std::string::npos)
        sentence += '.';
      return sentence;
    }
  } // namespace Text
} // namespace EBSMPM
