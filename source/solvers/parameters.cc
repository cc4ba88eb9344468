// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

// What a parameter file can contain: the sections and their parameters. What is
// worked out from the values is in parameters_values.cc.

#include <ebsmpm/materials/make_material.h>

#include <ebsmpm/solvers/parameters.h>

#include <deal.II/base/patterns.h>

namespace EBSMPM
{
  namespace internal
  {
    namespace ParametersImplementation
    {
      const Patterns::Double positive(1e-300, 1e300);
      const Patterns::Double not_negative(0., 1e300);
      const Patterns::Double fraction(0., 1.);
    } // namespace ParametersImplementation
  }   // namespace internal

  using namespace internal::ParametersImplementation;



  Parameters::Grid::Grid()
    : ParameterAcceptor("Background grid")
  {
    add_parameter("Dimension",
                  dimension,
                  "Number of space dimensions; plane strain in 2d.",
                  prm,
                  Patterns::Integer(2, 3));
    add_parameter("Degree",
                  degree,
                  "Degree of the B-splines.",
                  prm,
                  Patterns::Integer(1, 3));
    add_parameter("Cell size",
                  cell_size,
                  "Edge length h of the cells; a number or a formula.");
    add_parameter("Lower corner",
                  lower_corner,
                  "The corner from which the cells are laid out; formulas, "
                  "separated by commas.");
    add_parameter(
      "Upper corner",
      upper_corner,
      "The grid reaches at least to here. The body must stay inside "
      "while it moves.");
    add_parameter("Balance",
                  balance,
                  "Whether the grid is distributed among the processes by the "
                  "number of points, or else by the number of cells.");
    add_parameter("Largest imbalance",
                  imbalance,
                  "The grid is distributed anew after a step when some process "
                  "has this many times the mean number of points.",
                  prm,
                  Patterns::Double(1., 1e300));
  }



  Parameters::Body::Body()
    : ParameterAcceptor("Body")
  {
    add_parameter("Shape",
                  shape,
                  "The body: box, ball, half_space, expression, rotate, "
                  "translate, and +, -, & of these.");
    add_parameter("Points per direction",
                  n_points,
                  "Material points per cell and direction.",
                  prm,
                  Patterns::Integer(1, 100));
    add_parameter("Layout",
                  layout,
                  "Where the points of a cell are.",
                  prm,
                  Patterns::Selection("midpoint|Gauss"));
    add_parameter("Regions",
                  regions,
                  "Regions with other numbers of points per direction, "
                  "'number: shape', separated by semicolons.");
    add_parameter("Undamageable",
                  undamageable,
                  "Shapes in which the history field stays as it is, separated "
                  "by semicolons.");
    add_parameter("Boundaries",
                  boundaries,
                  "Parts of the surface that get boundary points, 'name: "
                  "condition' in x, y(, z) and the normal nx, ny(, nz), "
                  "separated by semicolons.");
    add_parameter("Boundary point spacing",
                  spacing,
                  "Largest distance of boundary points; a formula.");
  }



  Parameters::Notch::Notch()
    : ParameterAcceptor("Notch")
  {
    add_parameter("Type",
                  type,
                  "An initial crack: none (or a gap in the shape of the body), "
                  "slit (the points know from the start on which side they "
                  "are), or damage (a large history field in a band).",
                  prm,
                  Patterns::Selection("none|slit|damage"));
    add_parameter("Plane point", plane_point, "A point on the slit.");
    add_parameter("Plane normal", plane_normal, "Normal of the slit.");
    add_parameter("Region",
                  region,
                  "The shape in which the slit is open, or the damaged band.");
    add_parameter("Label width",
                  label_width,
                  "How far from the slit points know their side; a formula.");
    add_parameter("Label reach",
                  label_reach,
                  "How far ahead of its tip they do, for ever; a formula. Zero "
                  "for as far as from the slit.");
    add_parameter("Damage width",
                  damage_width,
                  "How far from the slit points make functions separable; a "
                  "formula.");
    add_parameter("Tip margin",
                  tip_margin,
                  "How far behind the tip of the slit they do; a formula. With "
                  "0.45*h, the length of the slit is right on average.");
    add_parameter(
      "Faces",
      faces,
      "Whether the faces of the slit are boundaries, slit.lower and "
      "slit.upper (to which the normal points), for Conditions and "
      "Tractions.");
    add_parameter("History factor",
                  history_factor,
                  "History field in the damaged band, in units of Gc/(2l).",
                  prm,
                  not_negative);
  }



  Parameters::Material::Material()
    : ParameterAcceptor("Material")
  {
    add_parameter("Model",
                  model,
                  "The stored energy.",
                  prm,
                  Patterns::Selection(material_names()));
    add_parameter("Energy split",
                  split,
                  "Which part of the energy is degraded by damage.",
                  prm,
                  Patterns::Selection(energy_split_names()));
    add_parameter(
      "Young's modulus", young_modulus, "Force per area.", prm, positive);
    add_parameter("Poisson's ratio",
                  poisson_ratio,
                  "Between -1 and 1/2.",
                  prm,
                  Patterns::Double(-0.999, 0.4999));
  }



  Parameters::Damage::Damage()
    : ParameterAcceptor("Damage")
  {
    add_parameter("Enable", enable, "Whether there is damage at all.");
    add_parameter("Fracture energy",
                  fracture_energy,
                  "The energy release rate Gc, energy per area.",
                  prm,
                  positive);
    add_parameter("Length scale",
                  length_scale,
                  "The length scale l of the phase field; a formula.");
    add_parameter("Residual stiffness",
                  residual_stiffness,
                  "The floor k of g(d) = max((1-d)^2, k).",
                  prm,
                  Patterns::Double(0., 0.5));
    add_parameter("Boundary term",
                  boundary_term,
                  "Whether the damage equation has the term that Nitsche's "
                  "method for the displacement entails.");
  }



  Parameters::Extension::Extension()
    : ParameterAcceptor("Extension")
  {
    add_parameter("Threshold",
                  threshold,
                  "Functions of which no more than this fraction is occupied "
                  "are extrapolated from others.",
                  prm,
                  Patterns::Double(0., 0.9));
    add_parameter("Hysteresis",
                  hysteresis,
                  "A function that was not extrapolated is not until its "
                  "fraction has sunk below the threshold by this part of it.",
                  prm,
                  Patterns::Double(0., 0.9));
  }



  Parameters::Nitsche::Nitsche()
    : ParameterAcceptor("Nitsche")
  {
    add_parameter("Penalty factor",
                  penalty_factor,
                  "The penalty beta in units of (K+4G/3)/h.",
                  prm,
                  positive);
    add_parameter("Penalty",
                  penalty,
                  "The penalty beta, force per volume; zero takes the factor "
                  "above.",
                  prm,
                  not_negative);
  }



  Parameters::Loading::Loading()
    : ParameterAcceptor("Loading")
  {
    add_parameter("Conditions",
                  conditions,
                  "Prescribed displacements, 'boundary.component = formula' in "
                  "x, y(, z) and the load u, separated by semicolons; "
                  "'boundary.normal = formula' lets the body slide along it.");
    add_parameter("Tractions",
                  tractions,
                  "Given forces per area, 'boundary.component = formula', or "
                  "'boundary.pressure = formula', as above. They refer to the "
                  "undeformed body.");
    add_parameter("Increments",
                  increments,
                  "Table of 'load: increment': up to this load, it grows by "
                  "these increments.");
    add_parameter("Driven boundary",
                  driven,
                  "Boundary and component whose force is the third column of "
                  "history.csv; or 'load' for the force that does work on the "
                  "load u (a torque, if u is an angle).");
    add_parameter("Minimum increment",
                  minimum_increment,
                  "Smallest increment to try when steps fail.",
                  prm,
                  positive);
    add_parameter(
      "Easy passes",
      easy_passes,
      "An increment that was cut back grows again after a step with "
      "no more passes than this.",
      prm,
      Patterns::Integer(0));
    add_parameter("Stop below",
                  stop_below,
                  "Stop when the force has fallen below this fraction of its "
                  "peak; zero for never.",
                  prm,
                  fraction);
  }



  Parameters::Staggered::Staggered()
    : ParameterAcceptor("Staggered")
  {
    add_parameter("Maximum passes",
                  maximum_passes,
                  "One is the single pass of Miehe et al. (2010); with more, "
                  "passes are repeated until they converge.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Tolerance",
                  tolerance,
                  "Change of the damage at which passes have converged.",
                  prm,
                  positive);
    add_parameter("Maximum relaxation",
                  relaxation,
                  "Largest factor of over-relaxation of the damage; one for "
                  "none.",
                  prm,
                  Patterns::Double(1.));
  }



  Parameters::Newton::Newton()
    : ParameterAcceptor("Newton")
  {
    add_parameter("Tolerance",
                  tolerance,
                  "For the residual, relative to the largest force so far.",
                  prm,
                  Patterns::Double(1e-15, 1e-2));
    add_parameter("Intermediate tolerance",
                  intermediate_tolerance,
                  "The same, as long as the staggered passes have not "
                  "converged.",
                  prm,
                  Patterns::Double(1e-15, 1e-1));
    add_parameter("Maximum iterations",
                  maximum_iterations,
                  "Iterations after which a step counts as failed.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Maximum bisections",
                  maximum_bisections,
                  "Number of times the line search halves a step.",
                  prm,
                  Patterns::Integer(0, 30));
    add_parameter("Indefinite tangent",
                  indefinite_tangent,
                  "What to do with a solution whose tangent has negative "
                  "pivots: an equilibrium that is not stable, or a penalty "
                  "factor that is too small.",
                  prm,
                  Patterns::Selection("accept|cut back"));
  }



  Parameters::Linear::Linear()
    : ParameterAcceptor("Linear solver")
  {
    add_parameter(
      "Displacement",
      displacement,
      "Method for the displacement. 'automatic' means a "
      "factorisation if the matrix is not too large, else multigrid.",
      prm,
      Patterns::Selection(LinearSolver::method_names()));
    add_parameter(
      "Damage",
      damage,
      "Method for the damage. 'automatic' means CG+IC if the length "
      "scale is less than 20 cells, else the same as for the "
      "displacement.",
      prm,
      Patterns::Selection(LinearSolver::method_names()));
    add_parameter("Refresh iterations",
                  refresh_iterations,
                  "Iterations after which an old factorisation or hierarchy is "
                  "made anew, at least: a large factorisation of MUMPS lasts "
                  "longer.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Maximum iterations",
                  maximum_iterations,
                  "Iterations after which a linear solve counts as failed.",
                  prm,
                  Patterns::Integer(1));
  }



  Parameters::Partition::Partition()
    : ParameterAcceptor("Crack partition")
  {
    add_parameter("Enable",
                  enable,
                  "Whether diffusive cracks become discrete (PF-MPM-DFG) or "
                  "stay diffusive (PF-MPM).");
    add_parameter("Damage threshold",
                  damage_threshold,
                  "The damage d_cr beyond which functions are separable.",
                  prm,
                  Patterns::Double(0.05, 0.999));
    add_parameter("Closure damage",
                  closure_damage,
                  "The damage that makes a ridge for the closure of gaps.",
                  prm,
                  Patterns::Double(0.05, 0.999));
    add_parameter("Remainder majority",
                  remainder_majority,
                  "In 3d, how much more material a function that the crack has "
                  "passed must have on its own side, relative to all, to be "
                  "separable without damage.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Clear ridge ratio",
                  frozen_ratio,
                  "Ratio of principal variances below which sides are settled.",
                  prm,
                  fraction);
    add_parameter("Ridge radius",
                  ridge_radius,
                  "Radius, in cells, in which the ridge's shape is determined. "
                  "Zero for one and a half times the length scale, but four at "
                  "least.",
                  prm,
                  Patterns::Integer(0, 20));
    add_parameter("Maximum passes",
                  maximum_passes,
                  "Staggered passes after which the partition of a step stays "
                  "as it is.",
                  prm,
                  Patterns::Integer(1));
  }



  Parameters::Output::Output()
    : ParameterAcceptor("Output")
  {
    add_parameter("Directory", directory, "Where all files go.");
    add_parameter(
      "Interval",
      interval,
      "Number of load steps between two outputs of the fields; zero "
      "for none.",
      prm,
      Patterns::Integer(0));
  }



  Parameters::Checkpoint::Checkpoint()
    : ParameterAcceptor("Checkpoint")
  {
    add_parameter(
      "Interval",
      interval,
      "Number of load steps between two checkpoints, and one more at "
      "the end; zero for none. Only the last is kept.",
      prm,
      Patterns::Integer(0));
    add_parameter("Resume",
                  resume,
                  "Whether to continue the run in 'Output/Directory' from its "
                  "last checkpoint. Increments beyond it, and how systems of "
                  "equations are solved, may be others now.");
  }
} // namespace EBSMPM
