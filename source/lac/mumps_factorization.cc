// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/lac/mumps_factorization.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Export.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <vector>

// Trilinos' interface to MUMPS includes the same header, so that whoever has
// the former has the latter. The library must be on the linker's command line.
#if __has_include(<dmumps_c.h>) && !defined(EBSMPM_WITHOUT_MUMPS)
#  include <dmumps_c.h>
#  define EBSMPM_HAVE_MUMPS
#  ifdef EBSMPM_HAVE_SMUMPS
#    include <smumps_c.h>
#  endif
#endif

namespace EBSMPM
{
#ifdef EBSMPM_HAVE_MUMPS

  namespace
  {
    // Entries per row, on average, up to which the problem counts as a
    // two-dimensional one.
    constexpr double two_dimensional_row_length = 100.;

    // How many operations a factorisation makes while an iteration gets through
    // an entry of the factors: these come from memory, and twice, and there are
    // the matrix and the correction, too.
    constexpr double operations_in_time_of_entry = 150.;

    // What MUMPS offers for a type of numbers. A pivot is considered to vanish
    // if its size, relative to the norm of the scaled matrix, is below the
    // tolerance.
    template <typename Number>
    struct Mumps;

    // The pivots of a loose body are round-off, which grows with the number of
    // unknowns, up to 1e-11 for 33,000. A body that is held by a strip of a
    // millionth of its stiffness has none below 1e-8.
    template <>
    struct Mumps<double>
    {
      using Structure                              = DMUMPS_STRUC_C;
      static constexpr double null_pivot_tolerance = 1e-10;

      static void
      call(Structure &structure)
      {
        dmumps_c(&structure);
      }
    };

#  ifdef EBSMPM_HAVE_SMUMPS
    // Here, a small pivot only means that we had better look twice.
    template <>
    struct Mumps<float>
    {
      using Structure                              = SMUMPS_STRUC_C;
      static constexpr double null_pivot_tolerance = 1e-5;

      static void
      call(Structure &structure)
      {
        smumps_c(&structure);
      }
    };
#  endif



    /**
     * The upper triangle of a matrix, in coordinates counted from one.
     */
    struct Entries
    {
      explicit Entries(const Epetra_CrsMatrix &A)
      {
        rows.reserve(A.NumMyNonzeros() / 2 + A.NumMyRows());
        columns.reserve(rows.capacity());
        values.reserve(rows.capacity());
        for (int i = 0; i < A.NumMyRows(); ++i)
          {
            int     n_entries;
            double *row_values;
            int    *row_columns;
            A.ExtractMyRowView(i, n_entries, row_values, row_columns);
            const int row = A.GRID(i);
            for (int k = 0; k < n_entries; ++k)
              {
                const int column = A.GCID(row_columns[k]);
                if (column >= row)
                  {
                    rows.push_back(row + 1);
                    columns.push_back(column + 1);
                    values.push_back(row_values[k]);
                  }
              }
          }
      }

      std::vector<int>    rows;
      std::vector<int>    columns;
      std::vector<double> values;
    };



    /**
     * A factorisation in one precision.
     */
    template <typename Number>
    class Factorisation
    {
    public:
      Factorisation(const Epetra_CrsMatrix &A,
                    const Entries          &entries,
                    const unsigned int      block_size)
        : row_map(A.RowMap())
        , communicator(
            dynamic_cast<const Epetra_MpiComm &>(A.RowMap().Comm()).Comm())
        , rows(entries.rows)
        , columns(entries.columns)
      {
        mumps.comm_fortran = MPI_Comm_c2f(communicator);
        mumps.par          = 1; // the first process works, too
        mumps.sym          = 2; // symmetric, perhaps indefinite
        call(-1);

        icntl(1) = icntl(2) = icntl(3) = -1; // no output
        icntl(4)                       = 0;
        icntl(14)                      = 30; // per cent of additional memory
        icntl(18)                      = 3;  // distributed matrix
        icntl(20)                      = 10; // distributed right hand side
        icntl(21)                      = 1;  // distributed solution
        icntl(24)                      = 1;  // look for null pivots
        mumps.cntl[2]                  = Mumps<Number>::null_pivot_tolerance;

        // Approximate minimum fill wins in two dimensions: 20 % less work than
        // the automatic choice, and half of its time for the analysis.
        const double row_length =
          A.NumGlobalNonzeros() / std::max(1., 1. * A.NumGlobalRows());
        if (row_length < two_dimensional_row_length)
          icntl(7) = 2;

        // Analyse the graph of the blocks.
        mumps.n = A.NumGlobalRows();
        if (block_size > 1 && mumps.n % block_size == 0)
          icntl(15) = -static_cast<int>(block_size);
        mumps.nnz_loc = rows.size();
        mumps.irn_loc = rows.data();
        mumps.jcn_loc = columns.data();
        call(1);
      }

      ~Factorisation()
      {
        mumps.job = -2;
        Mumps<Number>::call(mumps);
      }

      /**
       * Return whether the entries of a matrix are where those of the first one
       * were, on all processes.
       */
      bool
      fits(const Epetra_CrsMatrix &A, const Entries &entries) const
      {
        if (!A.RowMap().SameAs(row_map))
          return false;
        const bool same = (entries.rows == rows && entries.columns == columns);
        return dealii::Utilities::MPI::min(same ? 1 : 0, communicator) == 1;
      }

      void
      factorise(const Entries &entries)
      {
        values.assign(entries.values.begin(), entries.values.end());
        mumps.a_loc = values.data();
        mumps.job   = 2;
        Mumps<Number>::call(mumps);
        // More memory than expected: MUMPS leaves it to us to ask for it.
        while ((mumps.infog[0] == -8 || mumps.infog[0] == -9) &&
               icntl(14) < 1000)
          {
            icntl(14) *= 3;
            Mumps<Number>::call(mumps);
          }
        check();
        AssertThrow(n_null_pivots() == 0,
                    ExcSolverFailure("The matrix is singular: MUMPS found " +
                                     std::to_string(n_null_pivots()) +
                                     " vanishing pivots."));

        // Where MUMPS has put the unknowns is known after the first solution
        // with this factorisation.
        exporter.reset();
        solution.resize(std::max(1, mumps.info[22]));
        solution_rows.resize(solution.size());
        mumps.sol_loc  = solution.data();
        mumps.isol_loc = solution_rows.data();
        mumps.lsol_loc = solution.size();
        n_solution     = mumps.info[22];

        right_hand_side.resize(std::max(1, row_map.NumMyElements()));
        right_hand_side_rows.assign(right_hand_side.size(), 0);
        for (int i = 0; i < row_map.NumMyElements(); ++i)
          right_hand_side_rows[i] = row_map.GID(i) + 1;
        mumps.nrhs     = 1;
        mumps.nloc_rhs = row_map.NumMyElements();
        mumps.lrhs_loc = right_hand_side.size();
        mumps.rhs_loc  = right_hand_side.data();
        mumps.irhs_loc = right_hand_side_rows.data();
      }

      void
      solve(Epetra_MultiVector &dst, const Epetra_MultiVector &src)
      {
        std::copy(src[0], src[0] + src.MyLength(), right_hand_side.begin());
        call(3);
        if (!exporter)
          {
            std::vector<int> indices(n_solution);
            for (int i = 0; i < n_solution; ++i)
              indices[i] = solution_rows[i] - 1;
            solution_map = std::make_unique<Epetra_Map>(
              -1, n_solution, indices.data(), 0, row_map.Comm());
            exporter = std::make_unique<Epetra_Export>(*solution_map, row_map);
            exported = std::make_unique<Epetra_Vector>(*solution_map, false);
          }
        std::copy(solution.begin(),
                  solution.begin() + n_solution,
                  exported->Values());
        dst.Export(*exported, *exporter, Insert);
      }

      int
      n_negative_pivots() const
      {
        return mumps.infog[11];
      }

      double
      n_operations() const
      {
        return mumps.rinfog[2];
      }

      /**
       * MUMPS counts in millions if there are many.
       */
      double
      n_entries() const
      {
        const double n = mumps.infog[28];
        return n >= 0. ? n : -1e6 * n;
      }

    private:
      int
      n_null_pivots() const
      {
        return mumps.infog[27];
      }

      /**
       * Return a parameter of MUMPS by the number it has in the manual.
       */
      int &
      icntl(const unsigned int i)
      {
        return mumps.icntl[i - 1];
      }

      void
      call(const int job)
      {
        mumps.job = job;
        Mumps<Number>::call(mumps);
        check();
      }

      /**
       * Raise an exception if MUMPS reports an error, which it does on all
       * processes.
       */
      void
      check() const
      {
        AssertThrow(
          mumps.infog[0] != -10 && mumps.infog[0] != -6,
          ExcSolverFailure(
            "The matrix is singular: MUMPS found a vanishing pivot."));
        AssertThrow(mumps.infog[0] >= 0,
                    ExcSolverFailure("MUMPS failed with the error " +
                                     std::to_string(mumps.infog[0]) +
                                     ", additional information " +
                                     std::to_string(mumps.infog[1]) + "."));
      }

      typename Mumps<Number>::Structure mumps = {};

      const Epetra_Map row_map;
      const MPI_Comm   communicator;

      std::vector<int>    rows;
      std::vector<int>    columns;
      std::vector<Number> values;

      std::vector<Number> right_hand_side;
      std::vector<int>    right_hand_side_rows;

      int                            n_solution = 0;
      std::vector<Number>            solution;
      std::vector<int>               solution_rows;
      std::unique_ptr<Epetra_Map>    solution_map;
      std::unique_ptr<Epetra_Export> exporter;
      std::unique_ptr<Epetra_Vector> exported;
    };



    template <typename Number>
    void
    factorise(std::unique_ptr<Factorisation<Number>> &factorisation,
              const Epetra_CrsMatrix                 &A,
              const Entries                          &entries,
              const unsigned int                      block_size)
    {
      if (!factorisation || !factorisation->fits(A, entries))
        {
          factorisation.reset(); // releases its memory first
          factorisation =
            std::make_unique<Factorisation<Number>>(A, entries, block_size);
        }
      factorisation->factorise(entries);
    }
  } // namespace



  /**
   * The factorisation that is in use, one of two.
   */
  struct MumpsFactorization::Data
  {
    void
    initialize(const Epetra_CrsMatrix &A, const unsigned int block_size)
    {
      const Entries entries(A);
#  ifdef EBSMPM_HAVE_SMUMPS
      // Once single precision was not good enough, it will not be in the next
      // Newton step either.
      if (!in_double_precision || !in_double_precision->fits(A, entries))
        {
          in_double_precision.reset();
          try
            {
              factorise(in_single_precision, A, entries, block_size);
              if (in_single_precision->n_negative_pivots() == 0)
                return;
            }
          catch (const ExcSolverFailure &)
            {}
          in_single_precision.reset();
        }
#  endif
      factorise(in_double_precision, A, entries, block_size);
    }

    void
    solve(Epetra_MultiVector &dst, const Epetra_MultiVector &src)
    {
#  ifdef EBSMPM_HAVE_SMUMPS
      if (in_single_precision)
        {
          in_single_precision->solve(dst, src);
          return;
        }
#  endif
      in_double_precision->solve(dst, src);
    }

    bool
    is_indefinite() const
    {
      return in_double_precision &&
             in_double_precision->n_negative_pivots() > 0;
    }

    double
    operations_per_entry() const
    {
      const auto ratio = [](const auto &factorisation) {
        return factorisation->n_operations() /
               std::max(1., factorisation->n_entries());
      };
#  ifdef EBSMPM_HAVE_SMUMPS
      if (in_single_precision)
        return ratio(in_single_precision);
#  endif
      return ratio(in_double_precision);
    }

#  ifdef EBSMPM_HAVE_SMUMPS
    std::unique_ptr<Factorisation<float>> in_single_precision;
#  endif
    std::unique_ptr<Factorisation<double>> in_double_precision;
  };



  void
  MumpsFactorization::initialize(const LA::SparseMatrix &A)
  {
    if (!data)
      data = std::make_unique<Data>();
    data->initialize(A.trilinos_matrix(), block_size);
  }



  void
  MumpsFactorization::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    data->solve(dst.trilinos_vector(), src.trilinos_vector());
  }



  bool
  MumpsFactorization::is_indefinite() const
  {
    return data->is_indefinite();
  }



  unsigned int
  MumpsFactorization::cost() const
  {
    return data->operations_per_entry() / operations_in_time_of_entry;
  }



  bool
  MumpsFactorization::is_available()
  {
    return true;
  }

#else

  struct MumpsFactorization::Data
  {};



  void
  MumpsFactorization::initialize(const LA::SparseMatrix &)
  {
    AssertThrow(false,
                ExcSolverFailure("The library was compiled without MUMPS; "
                                 "choose another linear solver."));
  }



  void
  MumpsFactorization::vmult(LA::Vector &, const LA::Vector &) const
  {
    Assert(false, ExcNotInitialized());
  }



  bool
  MumpsFactorization::is_indefinite() const
  {
    return false;
  }



  unsigned int
  MumpsFactorization::cost() const
  {
    return 0;
  }



  bool
  MumpsFactorization::is_available()
  {
    return false;
  }

#endif



  MumpsFactorization::MumpsFactorization() = default;



  MumpsFactorization::~MumpsFactorization() = default;



  void
  MumpsFactorization::set_block_size(const unsigned int size)
  {
    if (size != block_size)
      data.reset();
    block_size = size;
  }



  std::string
  MumpsFactorization::name() const
  {
    return "MUMPS";
  }
} // namespace EBSMPM
