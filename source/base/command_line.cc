// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Keep a header of boost from reporting what another one does.
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#  define BOOST_BIND_GLOBAL_PLACEHOLDERS
#endif

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>
#include <ebsmpm/base/parameter_catalogue.h>
#include <ebsmpm/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <fstream>
#include <new>
#include <regex>
#include <sstream>
#include <utility>

namespace EBSMPM
{
  using namespace Text;

  namespace
  {
    using Tree = boost::property_tree::ptree;

    /**
     * Set the parameter with the full name @p name, which must exist. Throws
     * ExcParameter for a wrong value.
     */
    void
    set_parameter(ParameterHandler         &prm,
                  const ParameterCatalogue &catalogue,
                  const std::string        &name,
                  const std::string        &value)
    {
      std::vector<std::string> path;
      std::istringstream       stream(name);
      for (std::string part; std::getline(stream, part, '/');)
        path.push_back(part);
      const std::string entry = path.back();
      path.pop_back();

      bool accepted = true;
      for (const std::string &section : path)
        prm.enter_subsection(section);
      try
        {
          prm.set(entry, value);
        }
      catch (const ParameterHandler::ExcValueDoesNotMatchPattern &)
        {
          accepted = false;
        }
      for (unsigned int i = 0; i < path.size(); ++i)
        prm.leave_subsection();

      AssertThrow(accepted, ExcParameter(name, value, catalogue.allowed(name)));
    }



    /**
     * Return the section, with a slash behind it, that is open in front of
     * line @p line of a prm file.
     */
    std::string
    section_at(const std::string &filename, const unsigned int line)
    {
      std::ifstream            file(filename);
      std::vector<std::string> path;
      std::string              text;
      for (unsigned int n = 1; n < line && std::getline(file, text); ++n)
        {
          text = in_one_line(text.substr(0, text.find('#')));
          if (text == "end" || text == "END")
            {
              if (!path.empty())
                path.pop_back();
            }
          else if (text.compare(0, 11, "subsection ") == 0 ||
                   text.compare(0, 11, "SUBSECTION ") == 0)
            path.push_back(text.substr(11));
        }

      std::string result;
      for (const std::string &section : path)
        result += section + '/';
      return result;
    }



    /**
     * Return, in one sentence, what ParameterHandler disliked about a prm file.
     */
    std::string
    explain(const ExceptionBase &exception, const ParameterCatalogue *catalogue)
    {
      std::ostringstream stream;
      exception.print_info(stream);
      const std::string info = in_one_line(stream.str());

      // None of the messages below is long, and regular expressions are
      // recursive.
      if (info.size() > 5000)
        return finish(info);

      std::smatch match;
      const auto  where = [&match]() {
        return "In line " + match[1].str() + " of " + quote(match[2]) + ", ";
      };
      const auto section = [&match]() {
        return section_at(match[2], std::stoi(match[1]));
      };

      if (std::regex_match(
            info,
            match,
            std::regex(R"(Line <(\d+)> of file <(.*)>: The entry value ?(.*) )"
                       R"(for the entry named (.*) does not match the given )"
                       R"(pattern: (\[.*\])\.?)")))
        return finish(where() + "the parameter " +
                      quote(section() + match[4].str()) + " is " +
                      quote(match[3]) + ", but must be " +
                      ParameterCatalogue::allowed_by(match[5]));

      if (std::regex_match(info,
                           match,
                           std::regex(
                             R"(Line <(\d+)> of file <(.*): There is no such )"
                             R"(subsection to be entered: (.*))")))
        return finish(where() + (catalogue != nullptr ?
                                   catalogue->unknown_section(match[3]) :
                                   "there is no section " + quote(match[3])));

      if (std::regex_match(
            info,
            match,
            std::regex(R"(Line <(\d+)> of file <(.*)>: No entry with name )"
                       R"(<(.*)> was declared .*)")))
        {
          const std::string name = section() + match[3].str();
          return finish(where() + (catalogue != nullptr ?
                                     catalogue->unknown(name) :
                                     "there is no parameter " + quote(name)));
        }

      if (std::regex_match(
            info,
            match,
            std::regex(R"(Line <(\d+)> of file <(.*)>: The line <(.*)> could )"
                       R"(not be parsed.*)")))
        return where() + quote(match[3]) +
               " begins with none of 'set', 'subsection', 'end' and 'include'.";

      if (std::regex_match(
            info,
            match,
            std::regex(R"(Line <(\d+)> of file <(.*)>: Invalid format of )"
                       R"('set' .*)")))
        return where() + "'set' is not followed by 'Name = value'.";

      if (std::regex_match(
            info,
            match,
            std::regex(R"(Line <(\d+)> of file <(.*)>: There is no subsection )"
                       R"(to leave here\.?)")))
        return where() + "'end' closes a section, but none is open.";

      if (std::regex_match(
            info,
            match,
            std::regex(R"(Line <(\d+)> of file <(.*)>: This line contains an )"
                       R"('include' .* file to include <(.*)> cannot .*)")))
        return where() + "the file " + quote(match[3]) +
               ", which is to be included, cannot be opened.";

      if (std::regex_match(
            info,
            match,
            std::regex(R"(There are unequal numbers of 'subsection' and 'end' )"
                       R"(.* <(.*)>\..*)")))
        return "The file " + quote(match[1]) +
               " has a 'subsection' without its 'end'.";

      // The rest has neither file nor line.
      if (std::regex_match(info,
                           match,
                           std::regex(R"(The string <(.*)> does not match )"
                                      R"(the given pattern <(\[.*\])>\.)")))
        return finish("The value of a parameter is " + quote(match[1]) +
                      ", but must be " +
                      ParameterCatalogue::allowed_by(match[2]));

      if (std::regex_match(info,
                           match,
                           std::regex(R"(You can't ask for entry <(.*)> you )"
                                      R"(have not yet declared\.)")))
        return finish(catalogue != nullptr ?
                        catalogue->unknown(match[1]) :
                        "There is no parameter " + quote(match[1]));

      return finish(info);
    }



    /**
     * Turn the contents of a JSON file into names and values.
     */
    void
    flatten(const Tree                                       &tree,
            const std::string                                &name,
            std::vector<std::pair<std::string, std::string>> &values)
    {
      if (tree.empty())
        values.emplace_back(name, tree.data());
      else if (tree.count("value") > 0)
        {
          // The long form that print_parameters() writes.
          flatten(tree.find("value")->second, name, values);
        }
      else if (tree.count("alias") > 0)
        {
          // Only in the long form, and has no value of its own.
        }
      else if (tree.front().first.empty())
        {
          // An array.
          std::string list;
          for (const auto &entry : tree)
            list += (list.empty() ? "" : ", ") + entry.second.data();
          values.emplace_back(name, list);
        }
      else
        for (const auto &[key, child] : tree)
          flatten(child, name.empty() ? key : name + '/' + key, values);
    }



    void
    read_json_parameters(ParameterHandler         &prm,
                         const ParameterCatalogue &catalogue,
                         const std::string        &filename)
    {
      Tree tree;
      try
        {
          std::ifstream file(filename);
          boost::property_tree::read_json(file, tree);
        }
      catch (const boost::property_tree::json_parser_error &error)
        {
          AssertThrow(false,
                      ExcInput(
                        "In line " + std::to_string(error.line()) + " of " +
                        quote(filename) +
                        ", the JSON is not valid: " + finish(error.message())));
        }

      std::vector<std::pair<std::string, std::string>> values;
      if (!tree.empty())
        flatten(tree, "", values);
      for (const auto &[name, value] : values)
        {
          AssertThrow(catalogue.has(name),
                      ExcInput("In " + quote(filename) + ", " +
                               finish(catalogue.unknown(name))));
          try
            {
              set_parameter(prm, catalogue, name, value);
            }
          catch (const ExcParameter &)
            {
              AssertThrow(false,
                          ExcInput("In " + quote(filename) +
                                   ", the parameter " + quote(name) + " is " +
                                   quote(value) + ", but must be " +
                                   finish(catalogue.allowed(name))));
            }
        }
    }
  } // namespace



  CommandLine::CommandLine(const int argc, const char *const *argv)
    : CommandLine(
        std::vector<std::string>(argv + std::min(argc, 1), argv + argc))
  {}



  CommandLine::CommandLine(const std::vector<std::string> &arguments)
    : action(Action::run)
    , style(ParameterHandler::PRM)
    , force(false)
  {
    const std::string see_help = " (see ebsmpm --help).";

    // Who asks for help gets it, whatever else is wrong.
    for (const std::string &argument : arguments)
      if (argument == "--help" || argument == "-h")
        {
          action = Action::help;
          return;
        }

    for (unsigned int i = 0; i < arguments.size(); ++i)
      {
        const std::string &argument = arguments[i];
        if (argument == "--version")
          action = Action::version;
        else if (argument == "--print-parameters")
          {
            action = Action::print_parameters;
            if (i + 1 < arguments.size() &&
                (arguments[i + 1] == "prm" || arguments[i + 1] == "json"))
              style = (arguments[++i] == "prm") ? ParameterHandler::PRM :
                                                  ParameterHandler::JSON;
          }
        else if (argument == "--force")
          force = true;
        else if (argument == "--set")
          {
            AssertThrow(i + 1 < arguments.size(),
                        ExcInput("--set is not followed by "
                                 "\"Section/Name = value\"" +
                                 see_help));
            settings.push_back(arguments[++i]);
          }
        else if (argument.compare(0, 6, "--set=") == 0)
          settings.push_back(argument.substr(6));
        else if (!argument.empty() && argument[0] == '-')
          {
            AssertThrow(false,
                        ExcInput("There is no option " + quote(argument) +
                                 see_help));
          }
        else
          {
            AssertThrow(ends_with(argument, ".prm") ||
                          ends_with(argument, ".json"),
                        ExcInput(quote(argument) +
                                 " is not a parameter file, whose name ends in "
                                 ".prm or .json" +
                                 see_help));
            AssertThrow(file.empty(),
                        ExcInput("There are two parameter files, " +
                                 quote(file) + " and " + quote(argument) +
                                 ", but only one can be run" + see_help));
            file = argument;
          }
      }

    AssertThrow(action != Action::run || !file.empty(),
                ExcInput("Name the parameter file to be run" + see_help));
  }



  std::string
  CommandLine::usage()
  {
    return "Usage: ebsmpm FILE.prm|.json [options]\n"
           "\n"
           "Run the simulation that a parameter file describes.\n"
           "\n"
           "  --set \"Section/Name = value\"\n"
           "                    change a parameter; can be repeated\n"
           "  --force           overwrite the results of an earlier run\n"
           "  --print-parameters [prm|json]\n"
           "                    print all parameters and their documentation,\n"
           "                    with the values of FILE and --set if given\n"
           "  --version         print the version\n"
           "  --help, -h        print this text\n"
           "\n"
           "The exit status is 0 after success and 1 after an error, which is\n"
           "described in one sentence.\n";
  }



  void
  read_parameters(ParameterHandler &prm, const std::string &filename)
  {
    AssertThrow(std::ifstream(filename),
                ExcInput("The parameter file " + quote(filename) +
                         " cannot be opened."));

    const ParameterCatalogue catalogue(prm);
    if (ends_with(filename, ".json"))
      read_json_parameters(prm, catalogue, filename);
    else if (ends_with(filename, ".prm"))
      {
        try
          {
            prm.parse_input(filename);
          }
        catch (const ExceptionBase &exception)
          {
            AssertThrow(false, ExcInput(explain(exception, &catalogue)));
          }
      }
    else
      AssertThrow(false,
                  ExcInput("The parameter file " + quote(filename) +
                           " ends neither in .prm nor in .json."));
  }



  void
  apply_settings(ParameterHandler               &prm,
                 const std::vector<std::string> &settings)
  {
    const ParameterCatalogue catalogue(prm);
    for (const std::string &setting : settings)
      {
        const std::size_t equal = setting.find('=');
        AssertThrow(equal != std::string::npos,
                    ExcInput("The setting " + quote(setting) +
                             " is not of the form 'Section/Name = value'."));

        const std::string value = Utilities::trim(setting.substr(equal + 1));

        // Forgive blanks around the slashes.
        std::string        name;
        std::istringstream stream(setting.substr(0, equal));
        for (std::string part; std::getline(stream, part, '/');)
          name += (name.empty() ? "" : "/") + Utilities::trim(part);

        AssertThrow(catalogue.has(name),
                    ExcInput("In the setting " + quote(setting) + ", " +
                             finish(catalogue.unknown(name))));
        set_parameter(prm, catalogue, name, value);
      }
  }



  std::string
  describe_exception(const std::exception &exception)
  {
    if (const auto *const e = dynamic_cast<const ExceptionBase *>(&exception))
      {
        std::string text = explain(*e, nullptr);
        if (!text.empty() && text != "(none).")
          return text;

        // An exception without words: say which one, and where it happened.
        std::ostringstream stream;
        e->print_exc_data(stream);
        return finish(in_one_line(stream.str()));
      }

    if (dynamic_cast<const std::bad_alloc *>(&exception) != nullptr)
      return "There is not enough memory.";

    return finish(in_one_line(exception.what()));
  }



  void
  format_exception(const std::exception &exception, std::ostream &out)
  {
    out << describe_exception(exception) << std::endl;
  }
} // namespace EBSMPM
