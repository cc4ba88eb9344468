// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_archive_h
#define ebsmpm_output_archive_h

#include <ebsmpm/base/config.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <exception>
#include <fstream>
#include <string>

namespace EBSMPM
{
  /**
   * Files with objects that can be serialized with Boost, each with all digits
   * of its numbers. They are to be read on the same kind of computer.
   *
   * Both functions are local, and return what went wrong as the end of a
   * sentence that starts with the file; an empty string if all is well. See
   * first_message() for how to tell the other processes.
   */
  namespace Archive
  {
    /** Write @p object to the file @p filename. */
    template <typename T>
    std::string
    write(const std::string &filename, const T &object)
    {
      const std::string problem = "cannot be written (is the disk full?)";
      try
        {
          std::ofstream file(filename, std::ios::binary);
          if (!file)
            return problem;
          {
            boost::archive::binary_oarchive archive(file);
            archive << object;
          }
          file.flush();
          return file ? "" : problem;
        }
      catch (const std::exception &)
        {
          return problem;
        }
    }



    /** Read @p object from the file @p filename. */
    template <typename T>
    std::string
    read(const std::string &filename, T &object)
    {
      try
        {
          std::ifstream file(filename, std::ios::binary);
          if (!file)
            return "cannot be opened";
          boost::archive::binary_iarchive archive(file);
          archive >> object;
          return "";
        }
      catch (const std::exception &)
        {
          return "cannot be understood: it is damaged, or of another version "
                 "of this program";
        }
    }
  } // namespace Archive
} // namespace EBSMPM

#endif
