// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_tests_output_read_vtu_h
#define ebsmpm_tests_output_read_vtu_h

// Read the VTU files that the library has written, as far as the tests need it.

#include <ebsmpm/base/config.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace VTU
{
  using namespace dealii;

  inline std::string
  read_text(const std::string &filename)
  {
    std::ifstream file(filename);
    AssertThrow(file, ExcMessage("There is no file " + filename));
    return std::string(std::istreambuf_iterator<char>(file), {});
  }



  inline std::string
  attribute(const std::string &element, const std::string &key)
  {
    const std::size_t start = element.find(' ' + key + "=\"");
    if (start == std::string::npos)
      return "";
    const std::size_t first = start + key.size() + 3;
    return element.substr(first, element.find('"', first) - first);
  }



  /**
   * The fields of a VTU file, and the positions as field "".
   */
  struct Piece
  {
    std::map<std::string, unsigned int>        n_components;
    std::map<std::string, std::vector<double>> fields;
  };



  /**
   * Decode an array, encoded as a base64 header of four integers, the last of
   * which is the compressed size, and the base64 data compressed by zlib.
   */
  template <typename Number>
  std::vector<double>
  decode(const std::string &text)
  {
    const std::vector<unsigned char> header =
      Utilities::decode_base64(text.substr(0, 24));
    std::uint32_t sizes[4];
    std::memcpy(sizes, header.data(), sizeof(sizes));
    AssertThrow(sizes[0] == 1, ExcMessage("More than one block."));

    const std::vector<unsigned char> data =
      Utilities::decode_base64(text.substr(24));
    std::vector<Number> numbers(sizes[1] / sizeof(Number));
    uLongf              size = sizes[1];
    const int status = uncompress(reinterpret_cast<Bytef *>(numbers.data()),
                                  &size,
                                  data.data(),
                                  sizes[3]);
    AssertThrow(status == Z_OK && size == sizes[1],
                ExcMessage("Cannot decompress."));
    return std::vector<double>(numbers.begin(), numbers.end());
  }



  inline Piece
  read(const std::string &filename)
  {
    const std::string text = read_text(filename);
    Piece             piece;
    for (std::size_t start = text.find("<DataArray");
         start != std::string::npos;
         start = text.find("<DataArray", start + 1))
      {
        const std::size_t end     = text.find('>', start);
        const std::string element = text.substr(start, end - start);
        const std::string type    = attribute(element, "type");
        if (type.compare(0, 5, "Float") != 0 ||
            attribute(element, "format") != "binary")
          continue;
        const std::string n    = attribute(element, "NumberOfComponents");
        const std::string name = attribute(element, "Name");
        std::string data = text.substr(end + 1, text.find('<', end) - end - 1);
        data             = Utilities::trim(data);

        piece.n_components[name] = n.empty() ? 1 : std::stoi(n);
        piece.fields[name] =
          (type == "Float32") ? decode<float>(data) : decode<double>(data);
      }
    return piece;
  }



  /**
   * Read the pieces that a PVTU file lists and put them together.
   */
  inline Piece
  read_pieces(const std::string &filename, unsigned int &n_pieces)
  {
    const std::string text = read_text(filename);
    Piece             all;
    n_pieces = 0;
    for (std::size_t start = text.find("<Piece"); start != std::string::npos;
         start             = text.find("<Piece", start + 1))
      {
                    const Piece piece =
                      read(attribute(text.substr(start, text.find('>', start) - start),
                         "Source"));
                    all.n_components = piece.n_components;
                    for (const auto &[name, values] : piece.fields)
          all.fields[name].insert(all.fields[name].end(),
                                  values.begin(),
                                  values.end());
        ++n_pieces;
      }
    return all;
  }
} // namespace VTU

#endif
