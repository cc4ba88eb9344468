// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/expression.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace EBSMPM
{
  namespace
  {
    struct Function1
    {
      const char *name;
      double (*f)(double);
    };



    struct Function2
    {
      const char *name;
      double (*f)(double, double);
    };



    const Function1 functions_1[] = {
      {"abs", [](double x) { return std::abs(x); }},
      {"sqrt", [](double x) { return std::sqrt(x); }},
      {"exp", [](double x) { return std::exp(x); }},
      {"log", [](double x) { return std::log(x); }},
      {"sin", [](double x) { return std::sin(x); }},
      {"cos", [](double x) { return std::cos(x); }},
      {"tan", [](double x) { return std::tan(x); }},
      {"asin", [](double x) { return std::asin(x); }},
      {"acos", [](double x) { return std::acos(x); }},
      {"atan", [](double x) { return std::atan(x); }}};

    const Function2 functions_2[] = {
      {"min", [](double x, double y) { return std::min(x, y); }},
      {"max", [](double x, double y) { return std::max(x, y); }}};
  } // namespace



  // A recursive-descent parser: one function per level of precedence, each
  // calling the next tighter one for its operands.
  class Expression::Parser
  {
  public:
    Parser(const std::string                   &text,
           const std::size_t                    position,
           const std::vector<std::string>      &variables,
           const std::map<std::string, double> &constants)
      : text(text)
      , position(position)
      , variables(variables)
      , constants(constants)
    {}



    void
    disjunction()
    {
      conjunction();
      while (accept("||"))
        {
          conjunction();
          push(Operation::disjunction);
        }
    }



    void
    sum()
    {
      product();
      while (true)
        if (accept("+"))
          {
            product();
            push(Operation::add);
          }
        else if (accept("-"))
          {
            product();
            push(Operation::subtract);
          }
        else
          return;
    }



    void
    finish()
    {
      skip_space();
      if (position != text.size())
        fail("an operator or the end");
    }



    std::size_t
    get_position() const
    {
      return position;
    }



    std::vector<Step> steps;

  private:
    void
    conjunction()
    {
      comparison();
      while (accept("&&"))
        {
          comparison();
          push(Operation::conjunction);
        }
    }



    void
    comparison()
    {
      sum();
      // The longer operators first: "<" is also the beginning of "<=".
      for (const auto &candidate :
           {std::make_pair("<=", Operation::less_equal),
            std::make_pair(">=", Operation::greater_equal),
            std::make_pair("==", Operation::equal),
            std::make_pair("!=", Operation::unequal),
            std::make_pair("<", Operation::less),
            std::make_pair(">", Operation::greater)})
        if (accept(candidate.first))
          {
            sum();
            push(candidate.second);
            return;
          }
    }



    void
    product()
    {
      sign();
      while (true)
        if (accept("*"))
          {
            sign();
            push(Operation::multiply);
          }
        else if (accept("/"))
          {
            sign();
            push(Operation::divide);
          }
        else
          return;
    }



    void
    sign()
    {
      if (accept("-"))
        {
          sign();
          push(Operation::negate);
        }
      else if (accept("+"))
        sign();
      else if (accept("!"))
        {
          sign();
          push(Operation::invert);
        }
      else
        power();
    }



    void
    power()
    {
      primary();
      // The power binds to the right, and its exponent may have a sign.
      if (accept("^"))
        {
          sign();
          push(Operation::power);
        }
    }



    void
    primary()
    {
      skip_space();
      if (accept("("))
        {
          disjunction();
          expect(")");
          return;
        }

      const char c = (position < text.size() ? text[position] : '\0');
      if (std::isdigit(static_cast<unsigned char>(c)) || c == '.')
        {
          char        *end;
          const double number = std::strtod(text.c_str() + position, &end);
          if (end == text.c_str() + position)
            fail("a number");
          position = end - text.c_str();
          push(Operation::number, number);
        }
      else if (std::isalpha(static_cast<unsigned char>(c)) || c == '_')
        named();
      else
        fail("a number");
    }



    void
    named()
    {
      const std::size_t begin = position;
      while (position < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[position])) ||
              text[position] == '_'))
        ++position;
      const std::string name = text.substr(begin, position - begin);

      const auto variable = std::find(variables.begin(), variables.end(), name);
      if (variable != variables.end())
        return push(Operation::variable, 0, variable - variables.begin());

      const auto constant = constants.find(name);
      if (constant != constants.end())
        return push(Operation::number, constant->second);

      if (name == "pi")
        return push(Operation::number, numbers::PI);

      for (const Function1 &function : functions_1)
        if (name == function.name)
          {
            expect("(");
            disjunction();
            expect(")");
            return push(Operation::function_1, 0, &function - functions_1);
          }

      for (const Function2 &function : functions_2)
        if (name == function.name)
          {
            expect("(");
            disjunction();
            expect(",");
            disjunction();
            expect(")");
            return push(Operation::function_2, 0, &function - functions_2);
          }

      std::string known = "a number or a function instead of '" + name + "'";
      if (variables.size() > 0)
        {
          known += ", or one of the variables";
          for (const std::string &v : variables)
            known += " " + v;
        }
      position = begin;
      fail(known);
    }



    void
    skip_space()
    {
      while (position < text.size() &&
             std::isspace(static_cast<unsigned char>(text[position])))
        ++position;
    }



    bool
    accept(const std::string &token)
    {
      skip_space();
      if (text.compare(position, token.size(), token) != 0)
        return false;
      position += token.size();
      return true;
    }



    void
    expect(const std::string &token)
    {
      if (!accept(token))
        fail("'" + token + "'");
    }



    [[noreturn]] void
    fail(const std::string &expected) const
    {
      AssertThrow(false,
                  ExcInput("In '" + text + "', at position " +
                           std::to_string(position + 1) + ", there should be " +
                           expected + "."));
      std::abort();
    }



    void
    push(const Operation    operation,
         const double       number = 0,
         const unsigned int index  = 0)
    {
      steps.push_back({operation, number, index});
    }



    const std::string                   &text;
    std::size_t                          position;
    const std::vector<std::string>      &variables;
    const std::map<std::string, double> &constants;
  };



  Expression::Expression(const std::string                   &text,
                         const std::vector<std::string>      &variables,
                         const std::map<std::string, double> &constants)
  {
    Parser parser(text, 0, variables, constants);
    parser.disjunction();
    parser.finish();
    steps = parser.steps;
  }



  double
  Expression::value(const ArrayView<const double> &variables) const
  {
    return evaluate(steps, variables);
  }



  double
  Expression::parse_number(const std::string                   &text,
                           std::size_t                         &position,
                           const std::map<std::string, double> &constants)
  {
    const std::vector<std::string> no_variables;
    Parser parser(text, position, no_variables, constants);
    parser.sum();
    position = parser.get_position();
    return evaluate(parser.steps, ArrayView<const double>());
  }



  double
  Expression::evaluate(const std::vector<Step>       &steps,
                       const ArrayView<const double> &variables)
  {
    std::vector<double> stack;
    stack.reserve(steps.size());

    for (const Step &step : steps)
      {
        if (step.operation == Operation::number)
          stack.push_back(step.number);
        else if (step.operation == Operation::variable)
          stack.push_back(variables[step.index]);
        else if (step.operation == Operation::negate)
          stack.back() = -stack.back();
        else if (step.operation == Operation::invert)
          stack.back() = (stack.back() == 0);
        else if (step.operation == Operation::function_1)
          stack.back() = functions_1[step.index].f(stack.back());
        else
          {
            const double y = stack.back();
            stack.pop_back();
            double &x = stack.back();
            switch (step.operation)
              {
                case Operation::add:
                  x += y;
                  break;
                case Operation::subtract:
                  x -= y;
                  break;
                case Operation::multiply:
                  x *= y;
                  break;
                case Operation::divide:
                  x /= y;
                  break;
                case Operation::power:
                  x = std::pow(x, y);
                  break;
                case Operation::less:
                  x = (x < y);
                  break;
                case Operation::less_equal:
                  x = (x <= y);
                  break;
                case Operation::greater:
                  x = (x > y);
                  break;
                case Operation::greater_equal:
                  x = (x >= y);
                  break;
                case Operation::equal:
                  x = (x == y);
                  break;
                case Operation::unequal:
                  x = (x != y);
                  break;
                case Operation::conjunction:
                  x = (x != 0 && y != 0);
                  break;
                case Operation::disjunction:
                  x = (x != 0 || y != 0);
                  break;
                case Operation::function_2:
                  x = functions_2[step.index].f(x, y);
                  break;
                default:
                  Assert(false, ExcInternalError());
              }
          }
      }

    AssertDimension(stack.size(), 1);
    return stack.back();
  }
} // namespace EBSMPM
