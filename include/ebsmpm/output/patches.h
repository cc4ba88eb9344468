// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_patches_h
#define ebsmpm_output_patches_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/data_out_base.h>

#include <deal.II/numerics/data_component_interpretation.h>

#include <string>
#include <tuple>
#include <vector>

namespace EBSMPM
{
  /**
   * The list of patches and of named fields that deal.II's writers of graphics
   * files ask for.
   *
   * PointWriter fills it with points (<tt>dim</tt> zero) and GridWriter with
   * cells, and VTUSeries writes it. DataOut and Particles::DataOut do the same
   * for fields that belong to a DoFHandler and for all properties of particles
   * one by one; here, a field is whatever a program computes.
   *
   * Graphics files hold numbers in single precision, and that is how they are
   * stored.
   *
   * @code
   * Patches<0, dim> patches;
   * patches.declare("damage",
   *                 DataComponentInterpretation::component_is_scalar);
   * DataOutBase::Patch<0, dim> patch;
   * ...
   * patches.add(patch);
   * patches.write_vtu(file);
   * @endcode
   */
  template <int dim, int spacedim = dim>
  class Patches : public DataOutInterface<dim, spacedim>
  {
  public:
    /**
     * How the components of a field belong together.
     */
    using Interpretation =
      DataComponentInterpretation::DataComponentInterpretation;

    /**
     * Declare the next field: one component for a scalar, <tt>spacedim</tt> for
     * a vector and <tt>spacedim*spacedim</tt> for a tensor.
     */
    void
    declare(const std::string &name, const Interpretation interpretation);

    /**
     * Append a patch, and number it. Its data has one row for each component
     * of all fields.
     */
    void
    add(const DataOutBase::Patch<dim, spacedim> &patch);

    /**
     * Return the number of patches on this rank.
     */
    unsigned int
    n_patches() const;

    /**
     * Return the number of components of all fields together.
     */
    unsigned int
    n_components() const;

    /**
     * Return the name of the field that component @p component belongs to.
     */
    const std::string &
    component_name(const unsigned int component) const;

    /**
     * Whether @p value is finite in single precision.
     */
    static bool
    is_finite(const double value);

  protected:
    virtual const std::vector<DataOutBase::Patch<dim, spacedim>> &
    get_patches() const override;

    virtual std::vector<std::string>
    get_dataset_names() const override;

    virtual std::vector<
      std::tuple<unsigned int, unsigned int, std::string, Interpretation>>
    get_nonscalar_data_ranges() const override;

  private:
    std::vector<DataOutBase::Patch<dim, spacedim>> patches;

    /**
     * One name for each component; those of a vector share theirs.
     */
    std::vector<std::string> component_names;

    std::vector<
      std::tuple<unsigned int, unsigned int, std::string, Interpretation>>
      nonscalar_ranges;
  };
} // namespace EBSMPM

#endif
