// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------
// Parameters of two runs are compared: the first one that must not differ is
// named, with both values.

#include <ebsmpm/base/command_line.h>
#include <ebsmpm/base/exceptions.h>
#include <ebsmpm/base/parameter_values.h>

#include <deal.II/base/patterns.h>

#include "../tests.h"



void
declare(ParameterHandler &prm)
{
  prm.declare_entry("Name", "a b", Patterns::Anything());
  prm.enter_subsection("Background grid");
  prm.declare_entry("Cell size", "1/31", Patterns::Anything());
  prm.declare_alias("Cell size", "h");
  prm.enter_subsection("More");
  prm.declare_entry("Number", "1", Patterns::Double());
  prm.leave_subsection();
  prm.leave_subsection();
}



void
compare(const ParameterValues &values, const ParameterValues &required)
{
  try
    {
      require_same_parameters(
        values,
        required,
        [](const std::string &name) { return name == "Name"; },
        "as in the earlier run");
      deallog << "the same" << std::endl;
    }
  catch (const ExcParameter &exception)
    {
      deallog << describe_exception(exception) << std::endl;
    }
}



int
main()
{
  initlog();

  ParameterHandler prm;
  declare(prm);
  const ParameterValues before = parameter_values(prm);
  for (const auto &[name, value] : before)
    deallog << name << " = " << value << std::endl;
  compare(before, before);

  apply_settings(prm, {"Name = \"c\", d;\\"});
  compare(parameter_values(prm), before);

  apply_settings(prm, {"Background grid/More/Number = 2"});
  compare(parameter_values(prm), before);
  apply_settings(prm, {"Background grid/h = 1/32"});
  compare(parameter_values(prm), before);
  compare(before, parameter_values(prm));

  // Parameters that one of them does not know.
  ParameterValues fewer = before;
  fewer.erase("Background grid/Cell size");
  compare(before, fewer);
  compare(fewer, before);
}
