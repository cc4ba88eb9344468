// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_base_parameter_catalogue_h
#define ebsmpm_base_parameter_catalogue_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/ptree_fwd.hpp>

#include <map>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * The names of all parameters that a ParameterHandler knows, and what they
   * allow, for messages that help whoever has made a mistake in a parameter
   * file.
   *
   * ParameterHandler can be asked for a parameter by its name, but neither for
   * all names nor for words that say what a pattern allows. This class collects
   * both, once, when it is constructed; read_parameters() and apply_settings()
   * say with it what is wrong. Names are full names, with the sections in
   * front: <tt>Section/Subsection/Name</tt>.
   *
   * @code
   * const ParameterCatalogue catalogue(prm);
   * if (!catalogue.has("Background grid/Cell sise"))
   *   std::cerr << catalogue.unknown("Background grid/Cell sise");
   * // there is no parameter 'Background grid/Cell sise';
   * // did you mean 'Background grid/Cell size'?
   * @endcode
   *
   * A parameter that is declared later is not in the catalogue. Values are
   * neither stored nor checked. The constructor writes and parses all
   * declarations: make one catalogue for a file, not one for each parameter.
   */
  class ParameterCatalogue
  {
  public:
    /**
     * Constructor. Collects what has been declared in @p prm so far.
     */
    explicit ParameterCatalogue(const ParameterHandler &prm);

    /**
     * Return whether there is a parameter @p name, aliases included.
     */
    bool
    has(const std::string &name) const;

    /**
     * Return what the parameter @p name, which must exist, allows; in words, as
     * allowed_by() does.
     */
    std::string
    allowed(const std::string &name) const;

    /**
     * Return a sentence about the fact that there is no parameter @p name, and
     * up to three parameters with similar names. It begins with a small letter,
     * to be put behind the place where the name was found, and has a question
     * mark or nothing at its end.
     */
    std::string
    unknown(const std::string &name) const;

    /**
     * The same for a section.
     */
    std::string
    unknown_section(const std::string &name) const;

    /**
     * Return in words what a pattern allows, given what
     * Patterns::PatternBase::description() says about it; the end of a sentence
     * that says what a value must be, such as "a number of at least 0".
     */
    static std::string
    allowed_by(const std::string &pattern);

  private:
    /**
     * Collect the parameters in @p tree, which is what ParameterHandler writes
     * for the section that @p prefix names.
     */
    void
    collect(const boost::property_tree::ptree &tree, const std::string &prefix);

    /**
     * The descriptions of the patterns, by the names of the parameters.
     */
    std::map<std::string, std::string> patterns;

    /**
     * The names of all sections.
     */
    std::vector<std::string> sections;
  };
} // namespace EBSMPM

#endif
