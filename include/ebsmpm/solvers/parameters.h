// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_solvers_parameters_h
#define ebsmpm_solvers_parameters_h

#include <ebsmpm/base/config.h>

#include <ebsmpm/lac/linear_solver.h>

#include <ebsmpm/solvers/staggered_step.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <utility>
#include <vector>

namespace EBSMPM
{
  /**
   * The run-time parameters of a Simulation, a section of the parameter file
   * each. The defaults are the coarse tension test of step-5.
   *
   * The members carry what the file says. What has to be worked out from it
   * (numbers given as formulas, lists given as text) is behind functions, which
   * raise ExcParameter with the name of the parameter, its value and what is
   * allowed. check() calls them all, so that errors are found before anything
   * is computed or written.
   *
   * Several parameters are formulas, in which <tt>h</tt> is the cell size and
   * <tt>l</tt> the length scale of the damage.
   */
  struct Parameters
  {
    /** Section "Background grid". */
    struct Grid : public ParameterAcceptor
    {
      Grid();

      unsigned int dimension    = 2;
      unsigned int degree       = 2;
      std::string  cell_size    = "1/31";
      std::string  lower_corner = "-3*h, -3*h";
      std::string  upper_corner = "1+3*h, 1+3*h";
      bool         balance      = true;
      double       imbalance    = 1.3;
    } grid;

    /** Section "Body". */
    struct Body : public ParameterAcceptor
    {
      Body();

      std::string  shape        = "box(0,0, 1,1)";
      unsigned int n_points     = 3;
      std::string  layout       = "midpoint";
      std::string  regions      = "";
      std::string  undamageable = "";
      std::string  boundaries   = "bottom: y < 1e-9; top: y > 1 - 1e-9";
      std::string  spacing      = "h/3";
    } body;

    /** Section "Notch". */
    struct Notch : public ParameterAcceptor
    {
      Notch();

      std::string type           = "none";
      std::string plane_point    = "0.5, 0.5";
      std::string plane_normal   = "0, 1";
      std::string region         = "half_space(0.5,0.5, 1,0)";
      std::string label_width    = "5*h";
      std::string label_reach    = "0";
      std::string damage_width   = "1.01*h";
      std::string tip_margin     = "0";
      bool        faces          = false;
      double      history_factor = 1000;
    } notch;

    /** Section "Material". */
    struct Material : public ParameterAcceptor
    {
      Material();

      std::string model         = "neo-Hookean";
      std::string split         = "volumetric-deviatoric";
      double      young_modulus = 210;
      double      poisson_ratio = 0.3;
    } material;

    /** Section "Damage". */
    struct Damage : public ParameterAcceptor
    {
      Damage();

      bool        enable             = true;
      double      fracture_energy    = 2.7e-3;
      std::string length_scale       = "0.08";
      double      residual_stiffness = 1e-4;
      bool        boundary_term      = false;
    } damage;

    /** Section "Extension". */
    struct Extension : public ParameterAcceptor
    {
      Extension();

      double threshold  = 0.1;
      double hysteresis = 0.2;
    } extension;

    /** Section "Nitsche". */
    struct Nitsche : public ParameterAcceptor
    {
      Nitsche();

      double penalty_factor = 20;
      double penalty        = 0;
    } nitsche;

    /** Section "Loading". */
    struct Loading : public ParameterAcceptor
    {
      Loading();

      std::string conditions =
        "bottom.x = 0; bottom.y = 0; top.x = 0; top.y = u";
      std::string  tractions         = "";
      std::string  increments        = "0.003: 2e-4, 0.008: 2e-5";
      std::string  driven            = "top.y";
      double       minimum_increment = 1e-8;
      unsigned int easy_passes       = 20;
      double       stop_below        = 0;
    } loading;

    /** Section "Staggered". */
    struct Staggered : public ParameterAcceptor
    {
      Staggered();

      unsigned int maximum_passes = 1;
      double       tolerance      = 2e-3;
      double       relaxation     = 100.;
    } staggered;

    /** Section "Newton". */
    struct Newton : public ParameterAcceptor
    {
      Newton();

      double       tolerance              = 1e-10;
      double       intermediate_tolerance = 1e-5;
      unsigned int maximum_iterations     = 25;
      unsigned int maximum_bisections     = 8;
      std::string  indefinite_tangent     = "cut back";
    } newton;

    /** Section "Linear solver". */
    struct Linear : public ParameterAcceptor
    {
      Linear();

      std::string  displacement       = "automatic";
      std::string  damage             = "automatic";
      unsigned int refresh_iterations = 6;
      unsigned int maximum_iterations = 500;
    } linear;

    /** Section "Crack partition". */
    struct Partition : public ParameterAcceptor
    {
      Partition();

      bool         enable             = true;
      double       damage_threshold   = 0.9;
      double       closure_damage     = 0.5;
      double       frozen_ratio       = 0.2;
      double       remainder_majority = 0.75;
      unsigned int ridge_radius       = 0;
      unsigned int maximum_passes     = 50;
    } partition;

    /** Section "Output". */
    struct Output : public ParameterAcceptor
    {
      Output();

      std::string  directory = "output";
      unsigned int interval  = 20;
    } output;

    /** Section "Checkpoint". */
    struct Checkpoint : public ParameterAcceptor
    {
      Checkpoint();

      unsigned int interval = 0;
      bool         resume   = false;
    } checkpoint;

    /**
     * Check all values as far as possible without a grid. Raises ExcParameter
     * or ExcInput.
     */
    void
    check() const;

    /** The cell size $h$. */
    double
    cell_size() const;

    /** The length scale $l$. */
    double
    length_scale() const;

    /** The value of a formula with h and l in it, for the named parameter. */
    double
    number(const std::string &parameter, const std::string &formula) const;

    /** The coordinates given by a list of formulas. */
    template <int dim>
    Point<dim>
    point(const std::string &parameter, const std::string &formulas) const;

    /** Names and conditions of the boundaries. */
    std::vector<std::pair<std::string, std::string>>
    boundaries() const;

    /**
     * Names of all boundaries, by boundary id: those of boundaries(), and then
     * those of the faces of a slit that has them, the lower one first.
     */
    std::vector<std::string>
    boundary_names() const;

    /** Whether there is a slit whose faces are boundaries. */
    bool
    has_faces() const;

    /** The load table: up to which load, by which increments. */
    std::vector<std::pair<double, double>>
    increments() const;

    /**
     * The driven boundary and component whose force is reported first; the
     * invalid unsigned integer if it is the force that does work on the load.
     */
    std::pair<unsigned int, unsigned int>
    driven() const;

    /** The parameters of a load step. */
    template <int dim>
    typename StaggeredStep<dim>::AdditionalData
    step_data() const;
  };
} // namespace EBSMPM

#endif
