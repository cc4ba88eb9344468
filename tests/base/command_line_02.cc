// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// Parameters from files and from the command line: values arrive, and
// everything that is wrong is refused in one sentence.

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>

#include <cstdio>
#include <sstream>

#include "../tests.h"

struct Parameters
{
  double              cell_size = 1;
  unsigned int        n         = 2;
  bool                flag      = false;
  std::vector<double> table     = {1, 2};
  double              fraction  = 0.1;
  std::string         solver    = "direct";
  std::string         title;

  void
  declare(ParameterHandler &prm)
  {
    prm.add_parameter("Title", title);
    prm.enter_subsection("Background grid");
    {
      prm.add_parameter("Cell size", cell_size, "", Patterns::Double(0.));
      prm.add_parameter("Repetitions", n, "", Patterns::Integer(1));
      prm.enter_subsection("Details");
      {
        prm.add_parameter("Table", table);
        prm.add_parameter("Is periodic", flag);
      }
      prm.leave_subsection();
    }
    prm.leave_subsection();
    prm.enter_subsection("Extension");
    {
      prm.add_parameter("Threshold", fraction, "", Patterns::Double(0., 1.));
      prm.add_parameter("Solver",
                        solver,
                        "",
                        Patterns::Selection("direct|cg|gmres"));
      prm.declare_alias("Threshold", "Phi", true);
      prm.declare_entry("Origin",
                        "0, 0",
                        Patterns::List(Patterns::Double(), 2, 3));
      prm.declare_entry("Count", "3", Patterns::Integer(0, 9));
      prm.declare_entry("Pieces", "a", Patterns::MultipleSelection("a|b|c"));
      prm.declare_entry(
        "Upper", "0", Patterns::Double(Patterns::Double::min_double_value, 5));
      prm.declare_entry("Any number", "0", Patterns::Double());
      prm.declare_entry("Any integer", "0", Patterns::Integer());
      prm.declare_entry("Map",
                        "",
                        Patterns::Map(Patterns::Integer(), Patterns::Double()));
    }
    prm.leave_subsection();
  }

  void
  print() const
  {
    deallog << cell_size << ' ' << n << ' ' << flag << ' ' << table.size()
            << ' ' << table.back() << ' ' << fraction << ' ' << solver << " <"
            << title << '>' << std::endl;
  }
};



void
test_settings(const std::vector<std::string> &settings)
{
  Parameters       parameters;
  ParameterHandler prm;
  parameters.declare(prm);
  try
    {
      apply_settings(prm, settings);
      parameters.print();
    }
  catch (const std::exception &exception)
    {
      deallog << describe_exception(exception) << std::endl;

      // The handler is back at the top, and usable.
      prm.set("Title", "usable");
      if (parameters.title != "usable")
        deallog << "not usable" << std::endl;
    }
}



void
test_file(const std::string &filename, const std::string &text)
{
  std::ofstream(filename) << text;
  Parameters       parameters;
  ParameterHandler prm;
  parameters.declare(prm);
  try
    {
      read_parameters(prm, filename);
      parameters.print();
    }
  catch (const std::exception &exception)
    {
      deallog << describe_exception(exception) << std::endl;
    }
  std::remove(filename.c_str());
}



int
main()
{
  initlog();

  deallog.push("set");
  test_settings({});
  test_settings({"Background grid/Cell size = 0.5",
                 "Background grid / Details / Table = 1, 2,3 ",
                 "Background grid/Details/Is periodic=true",
                 "Title = a = b",
                 "Extension/Phi=0.25"});
  test_settings({"Title"});
  test_settings({"Background grid/Cell siz = 1"});
  test_settings({"background grid/cell sise = 1"});
  test_settings({"Cell size = 1"});
  test_settings({"Backround grid/Details/Tabel = 1"});
  test_settings({"Something else = 1"});
  test_settings({"Background grid = 1"});
  test_settings({" = 1"});
  test_settings({"Background grid/Cell size = -1"});
  test_settings({"Background grid/Repetitions = 2.5"});
  test_settings({"Background grid/Details/Is periodic = perhaps"});
  test_settings({"Background grid/Details/Table = 1, x"});
  test_settings({"Extension/Threshold = 1.5"});
  test_settings({"Extension/Solver = cgs"});
  test_settings({"Extension/Origin = 1"});
  test_settings({"Extension/Count = 10"});
  test_settings({"Extension/Pieces = d"});
  test_settings({"Extension/Upper = 6"});
  test_settings({"Extension/Any number = x"});
  test_settings({"Extension/Any integer = 1.5"});
  test_settings({"Extension/Map = 1"});
  deallog.pop();

  deallog.push("prm");
  test_file("good.prm",
            "subsection Background grid\n"
            "  set Cell size = 0.25 # in mm\n"
            "  subsection Details\n"
            "    set Table = 4, 5, 6\n"
            "  end\n"
            "end\n");
  test_file("value.prm",
            "# a comment\n"
            "subsection Background grid\n"
            "  subsection Details # a comment\n"
            "  end\n"
            "  set Cell size = -1\n"
            "end\n");
  test_file("section.prm", "subsection Backgroun grid\nend\n");
  test_file("section2.prm", "subsection Elsewhere\nend\n");
  test_file("name.prm", "subsection Extension\n  set Tresholt = 1\nend\n");
  test_file("top.prm", "set Cell size = 1\n");
  test_file("open.prm", "subsection Extension\n");
  test_file("closed.prm", "end\n");
  test_file("typo.prm", "sett Title = 1\n");
  test_file("form.prm", "set Title 1\n");
  test_file("include.prm", "include nowhere.prm\n");
  test_file("other.txt", "");
  deallog.pop();

  deallog.push("json");
  test_file("good.json",
            "{\"Title\": \"x\", \"Background grid\": {\"Cell size\": 0.25,\n"
            "\"Details\": {\"Table\": [4, 5, 6], \"Is periodic\": true}}}");
  test_file("empty.json", "{}");
  test_file("value.json", "{\"Background grid\": {\"Cell size\": \"-1\"}}");
  test_file("section.json", "{\"Back grid\": {\"Cell size\": \"1\"}}");
  test_file("name.json", "{\"Background grid\": {\"Cellsize\": 1}}");
  test_file("syntax.json", "{\"Title\": \"x\",\n\"Extension\" 1}");

  // What is printed can be read, in both styles.
  Parameters       parameters;
  ParameterHandler prm;
  parameters.declare(prm);
  apply_settings(prm,
                 {"Background grid/Details/Table = 7, 8, 9",
                  "Extension/Threshold = 0.75"});
  std::ostringstream json, short_json, text;
  prm.print_parameters(json, ParameterHandler::JSON);
  prm.print_parameters(short_json, ParameterHandler::ShortJSON);
  prm.print_parameters(text, ParameterHandler::PRM);
  test_file("printed.json", json.str());
  test_file("printed.json", short_json.str());
  test_file("printed.prm", text.str());
  deallog.pop();

  try
    {
      read_parameters(prm, "nowhere.prm");
    }
  catch (const ExcInput &exception)
    {
      deallog << describe_exception(exception) << std::endl;
    }

  // What deal.II says by itself.
  try
    {
      prm.set("Titel", "x");
    }
  catch (const std::exception &exception)
    {
      deallog << describe_exception(exception) << std::endl;
    }
  try
    {
      prm.enter_subsection("Extension");
      prm.set("Threshold", "x");
    }
  catch (const std::exception &exception)
    {
      deallog << describe_exception(exception) << std::endl;
    }
}
