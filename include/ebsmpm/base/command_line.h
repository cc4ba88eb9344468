// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_command_line_h
#define ebsmpm_base_command_line_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/parameter_handler.h>

#include <exception>
#include <ostream>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * What the user asks for on the command line of the executable.
   *
   * The three functions behind this class bring the wishes into a
   * ParameterHandler and the failures into words. Together, they make a main
   * program:
   *
   * @code
   * try
   *   {
   *     const CommandLine command_line(argc, argv);
   *     ParameterHandler  prm;
   *     parameters.declare(prm);
   *     read_parameters(prm, command_line.file);
   *     apply_settings(prm, command_line.settings);
   *     ...
   *   }
   * catch (const std::exception &exception)
   *   {
   *     std::cerr << "ebsmpm: ";
   *     format_exception(exception, std::cerr);
   *     return 1;
   *   }
   * @endcode
   *
   * Nothing here communicates or prints by itself. All ranks get the same
   * command line, and so arrive at the same result.
   */
  class CommandLine
  {
  public:
    /**
     * What to do.
     */
    enum class Action
    {
      /**
       * Run the parameter file.
       */
      run,

      /**
       * Print usage().
       */
      help,

      /**
       * Print the version.
       */
      version,

      /**
       * Print all parameters, with the values of the file if there is one.
       */
      print_parameters
    };

    /**
     * Parse the arguments of main(). Throws ExcInput with one sentence for an
     * argument that is not understood.
     */
    CommandLine(const int argc, const char *const *argv);

    /**
     * As above, for the arguments behind the name of the program.
     */
    explicit CommandLine(const std::vector<std::string> &arguments);

    Action action;

    /**
     * The parameter file. Empty if there is none, which cannot be if the
     * action is to run.
     */
    std::string file;

    /**
     * The style in which parameters are to be printed:
     * ParameterHandler::PRM or ParameterHandler::JSON.
     */
    ParameterHandler::OutputStyle style;

    /**
     * The arguments of all <tt>--set</tt>, in their order.
     */
    std::vector<std::string> settings;

    /**
     * Whether results of an earlier run may be overwritten.
     */
    bool force;

    /**
     * Return the text that <tt>--help</tt> prints.
     */
    static std::string
    usage();
  };

  /**
   * Read the values of @p prm from a file that ends in <tt>.prm</tt> or
   * <tt>.json</tt>.
   *
   * ParameterHandler::parse_input() does the same, but its exceptions say
   * neither which parameter a value in a JSON file is for nor which parameter
   * may have been meant. This function throws ExcInput with one sentence that
   * names the file, the parameter, the value, and what is allowed, and for a
   * <tt>.prm</tt> file the line. A list can be an array in a JSON file.
   */
  void
  read_parameters(ParameterHandler &prm, const std::string &filename);

  /**
   * Set the parameters of @p prm named in @p settings, one after the other.
   * Each is of the form
   * @code
   *   Section/Subsection/Name = value
   * @endcode
   *
   * Throws ExcInput for one that has another form or names no parameter, saying
   * which have similar names, and ExcParameter for a value that does not match
   * the pattern of its parameter.
   */
  void
  apply_settings(ParameterHandler               &prm,
                 const std::vector<std::string> &settings);

  /**
   * Return what went wrong, in one sentence and one line. Exceptions
   * of deal.II come as a box of many lines; only what they say about this
   * failure is kept, and those of ParameterHandler get better words. An
   * exception that says nothing about itself is described by the place where it
   * was thrown.
   */
  std::string
  describe_exception(const std::exception &exception);

  /**
   * Write describe_exception() and the end of the line to @p out.
   */
  void
  format_exception(const std::exception &exception, std::ostream &out);
} // namespace EBSMPM

#endif
