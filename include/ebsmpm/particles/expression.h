// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_particles_expression_h
#define ebsmpm_particles_expression_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/array_view.h>

#include <map>
#include <string>
#include <vector>

namespace EBSMPM
{
  /**
   * A formula with any number of variables, for example "y > 0.999 && ny > 0".
   *
   * FunctionParser offers as many variables as there are space dimensions. The
   * conditions that select a part of a surface know position and normal, and
   * the numbers inside of a shape's description must be found in the middle of
   * a longer text. For these two purposes there is this small class.
   *
   * It knows, from the loosest to the tightest: <tt>||</tt>, <tt>&&</tt>,
   * comparisons (<tt>&lt; &lt;= &gt; &gt;= == !=</tt>), <tt>+ -</tt>,
   * <tt>* /</tt>, signs and <tt>!</tt>, the power <tt>^</tt>, parentheses, the
   * functions abs, sqrt, exp, log, sin, cos, tan, asin, acos, atan, min, max
   * and the constant pi. True is 1, and everything but 0 is true.
   *
   * @code
   *   const Expression top("y > 0.999", {"x", "y"});
   *   if (top.value({{0.5, 1.0}}) != 0)
   *     ...
   * @endcode
   */
  class Expression
  {
  public:
    /**
     * Constructor. @p variables are the names of the variables, @p constants
     * further names with their values. If @p text is not a formula, ExcInput is
     * thrown with the position (counted from 1) and what was expected there.
     */
    Expression(const std::string                   &text,
               const std::vector<std::string>      &variables,
               const std::map<std::string, double> &constants = {});

    /**
     * Return the value of the formula, given the values of the variables in
     * the order of their names.
     */
    double
    value(const ArrayView<const double> &variables) const;

    /**
     * Read the longest formula without variables and logical operators that
     * begins at @p position of @p text, return its value, and let @p position
     * point behind it.
     */
    static double
    parse_number(const std::string                   &text,
                 std::size_t                         &position,
                 const std::map<std::string, double> &constants = {});

  private:
    class Parser;

    /**
     * What one step of the evaluation does.
     */
    enum class Operation
    {
      number,
      variable,
      negate,
      invert,
      add,
      subtract,
      multiply,
      divide,
      power,
      less,
      less_equal,
      greater,
      greater_equal,
      equal,
      unequal,
      conjunction,
      disjunction,
      function_1,
      function_2
    };

    /**
     * One step of the evaluation, which takes its operands from a stack and
     * leaves its result there.
     */
    struct Step
    {
      Operation    operation;
      double       number;
      unsigned int index;
    };

    /**
     * The steps in the order of evaluation (reverse Polish notation).
     */
    std::vector<Step> steps;

    /**
     * Carry out the steps.
     */
    static double
    evaluate(const std::vector<Step>       &steps,
             const ArrayView<const double> &variables);
  };
} // namespace EBSMPM

#endif
