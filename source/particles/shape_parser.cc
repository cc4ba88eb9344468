// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/particles/boolean_shapes.h>
#include <ebsmpm/particles/expression.h>
#include <ebsmpm/particles/primitive_shapes.h>
#include <ebsmpm/particles/shape_parser.h>
#include <ebsmpm/particles/transformed_shape.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cctype>
#include <cmath>
#include <cstdlib>

namespace EBSMPM
{
  namespace
  {
    Tensor<2, 2>
    rotation_matrix(const double angle, const Tensor<1, 2> & /*axis*/)
    {
      Tensor<2, 2> R;
      R[0][0] = R[1][1] = std::cos(angle);
      R[1][0]           = std::sin(angle);
      R[0][1]           = -R[1][0];
      return R;
    }



    // Rodrigues' formula.
    Tensor<2, 3>
    rotation_matrix(const double angle, const Tensor<1, 3> &axis)
    {
      const double       c = std::cos(angle);
      const double       s = std::sin(angle);
      const Tensor<1, 3> k = axis / axis.norm();
      Tensor<2, 3>       R;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Tensor<1, 3> column =
            cross_product_3d(k, Tensor<1, 3>(Point<3>::unit_vector(i)));
          for (unsigned int j = 0; j < 3; ++j)
            R[j][i] = s * column[j] + (1. - c) * k[i] * k[j];
          R[i][i] += c;
        }
      return R;
    }



    // A recursive-descent parser of the language that parse_shape() documents.
    template <int dim>
    class ShapeParser
    {
    public:
      using Body = std::shared_ptr<const Shape<dim>>;

      ShapeParser(const std::string                   &text,
                  const std::map<std::string, double> &constants)
        : text(text)
        , constants(constants)
        , position(0)
      {}



      Body
      parse()
      {
        const Body shape = sum();
        skip_space();
        if (position != text.size())
          fail("'+', '-', '&' or the end");
        return shape;
      }

    private:
      Body
      sum()
      {
        Body shape = intersection();
        while (true)
          if (accept('+'))
            shape = std::make_shared<UnionShape<dim>>(shape, intersection());
          else if (accept('-'))
            shape =
              std::make_shared<DifferenceShape<dim>>(shape, intersection());
          else
            return shape;
      }



      Body
      intersection()
      {
        Body shape = primary();
        while (accept('&'))
          shape = std::make_shared<IntersectionShape<dim>>(shape, primary());
        return shape;
      }



      Body
      primary()
      {
        if (accept('('))
          {
            const Body shape = sum();
            expect(')', "'+', '-', '&' or ')'");
            return shape;
          }

        const std::size_t begin = position;
        while (position < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[position])) ||
                text[position] == '_'))
          ++position;
        const std::string name = text.substr(begin, position - begin);

        Body shape;
        if (name == "box")
          {
            expect('(');
            const Point<dim> lower = coordinates();
            expect(',');
            const Point<dim> upper = coordinates();
            end_of_arguments();
            for (unsigned int d = 0; d < dim; ++d)
              if (!(lower[d] < upper[d]))
                fail_at(begin,
                        "a box whose first corner has smaller coordinates "
                        "than the second one");
            shape = std::make_shared<BoxShape<dim>>(lower, upper);
          }
        else if (name == "ball")
          {
            expect('(');
            const Point<dim> center = coordinates();
            expect(',');
            const double radius = number();
            end_of_arguments();
            if (!(radius > 0))
              fail_at(begin, "a ball with a positive radius");
            shape = std::make_shared<BallShape<dim>>(center, radius);
          }
        else if (name == "half_space")
          {
            expect('(');
            const Point<dim> point = coordinates();
            expect(',');
            const Tensor<1, dim> normal = coordinates();
            end_of_arguments();
            if (!(normal.norm() > 0))
              fail_at(begin, "a half space whose normal is not zero");
            shape = std::make_shared<HalfSpaceShape<dim>>(point, normal);
          }
        else if (name == "expression")
          {
            expect('(');
            const std::string formula = quoted();
            end_of_arguments();
            shape = std::make_shared<ExpressionShape<dim>>(formula, constants);
          }
        else if (name == "rotate")
          {
            expect('(');
            const double angle = number();
            expect(',');
            Tensor<1, dim> axis;
            if (dim == 3)
              {
                axis = coordinates();
                expect(',');
                if (!(axis.norm() > 0))
                  fail_at(begin, "a rotation about an axis that is not zero");
              }
            const Body original = sum();
            end_of_arguments();
            shape = std::make_shared<TransformedShape<dim>>(
              original, rotation_matrix(angle, axis));
          }
        else if (name == "translate")
          {
            expect('(');
            const Tensor<1, dim> shift = coordinates();
            expect(',');
            const Body original = sum();
            end_of_arguments();
            shape = std::make_shared<TransformedShape<dim>>(
              original, Tensor<2, dim>(unit_symmetric_tensor<dim>()), shift);
          }
        else
          fail_at(begin,
                  "'(' or one of box, ball, half_space, expression, rotate, "
                  "translate");
        return shape;
      }



      Point<dim>
      coordinates()
      {
        Point<dim> p;
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (d > 0)
              expect(',');
            p[d] = number();
          }
        return p;
      }



      double
      number()
      {
        const double x = Expression::parse_number(text, position, constants);
        if (!numbers::is_finite(x))
          fail("a finite number");
        return x;
      }



      std::string
      quoted()
      {
        skip_space();
        const char quote = (position < text.size() ? text[position] : '\0');
        if (quote != '"' && quote != '\'')
          fail("a formula in quotes");
        const std::size_t begin = ++position;
        position = std::min(text.find(quote, begin), text.size());
        if (position == text.size())
          fail(std::string("the closing ") + quote);
        return text.substr(begin, position++ - begin);
      }



      void
      skip_space()
      {
        while (position < text.size() &&
               std::isspace(static_cast<unsigned char>(text[position])))
          ++position;
      }



      bool
      accept(const char c)
      {
        skip_space();
        if (position == text.size() || text[position] != c)
          return false;
        ++position;
        skip_space();
        return true;
      }



      void
      expect(const char c, const std::string &expected = "")
      {
        if (!accept(c))
          fail(expected.empty() ? std::string("'") + c + "'" : expected);
      }



      // A primitive of the wrong dimension is the most common mistake.
      void
      end_of_arguments()
      {
        skip_space();
        if (position < text.size() && text[position] == ',')
          fail("')', since in " + std::to_string(dim) +
               "d there are no more arguments");
        expect(')');
      }



      [[noreturn]] void
      fail(const std::string &expected) const
      {
        fail_at(position, expected);
      }



      [[noreturn]] void
      fail_at(const std::size_t where, const std::string &expected) const
      {
        AssertThrow(false,
                    ExcInput("In '" + text + "', at position " +
                             std::to_string(where + 1) + ", there should be " +
                             expected + "."));
        std::abort();
      }



      const std::string                   &text;
      const std::map<std::string, double> &constants;
      std::size_t                          position;
    };
  } // namespace



  template <int dim>
  std::shared_ptr<const Shape<dim>>
  parse_shape(const std::string                   &text,
              const std::map<std::string, double> &constants)
  {
    return ShapeParser<dim>(text, constants).parse();
  }



  template std::shared_ptr<const Shape<2>>
  parse_shape<2>(const std::string &, const std::map<std::string, double> &);
  template std::shared_ptr<const Shape<3>>
  parse_shape<3>(const std::string &, const std::map<std::string, double> &);
} // namespace EBSMPM
