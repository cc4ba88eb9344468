// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// The command line: what is understood, and what is said about what is not.

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>

#include <sstream>

#include "../tests.h"

DeclException0(ExcWordless);



void
test(const std::vector<std::string> &arguments)
{
  for (const std::string &argument : arguments)
    deallog << argument << ' ';
  deallog << "-> ";
  try
    {
      const CommandLine command_line(arguments);
      switch (command_line.action)
        {
          case CommandLine::Action::run:
            deallog << "run";
            break;
          case CommandLine::Action::help:
            deallog << "help";
            break;
          case CommandLine::Action::version:
            deallog << "version";
            break;
          case CommandLine::Action::print_parameters:
            deallog << "print "
                    << (command_line.style == ParameterHandler::PRM ? "prm" :
                                                                      "json");
            break;
        }
      if (!command_line.file.empty())
        deallog << ", file " << command_line.file;
      for (const std::string &setting : command_line.settings)
        deallog << ", set <" << setting << '>';
      deallog << (command_line.force ? ", force" : "") << std::endl;
    }
  catch (const ExcInput &exception)
    {
      deallog << "refused: " << describe_exception(exception) << std::endl;
    }
}



int
main()
{
  initlog();

  test({"a.prm"});
  test({"a.json", "--force"});
  test({"--set", "A/B = 1", "a.prm", "--set=C = 2"});
  test({"--help"});
  test({"--wrong-afterwards", "-h"});
  test({"a.prm", "-h", "--wrong"});
  test({"--version"});
  test({"--print-parameters"});
  test({"--print-parameters", "prm"});
  test({"--print-parameters", "json"});
  test({"--print-parameters", "a.prm", "--set", "A = 1"});

  test({});
  test({"--force"});
  test({"--colour"});
  test({"a.txt"});
  test({"a.prm", "b.prm"});
  test({"a.prm", "--set"});

  const char *const argv[] = {"ebsmpm", "c.prm"};
  deallog << CommandLine(2, argv).file << std::endl;

  std::istringstream usage(CommandLine::usage());
  std::string        line;
  std::getline(usage, line);
  deallog << line << std::endl;

  std::ostringstream message;
  format_exception(std::runtime_error("two\n  lines"), message);
  format_exception(std::bad_alloc(), message);
  format_exception(ExcFile("a", "is bad"), message);
  deallog << message.str();
  deallog << std::endl;

  // An exception that says nothing is described by where it comes from, which
  // includes the numbers of lines.
  try
    {
      AssertThrow(1 + 1 == 3, ExcWordless());
    }
  catch (const std::exception &exception)
    {
      const std::string text = describe_exception(exception);
      deallog << (text.find("1 + 1 == 3") != std::string::npos)
              << (text.find("command_line_01") != std::string::npos)
              << (text.find('\n') == std::string::npos) << std::endl;
    }
}
