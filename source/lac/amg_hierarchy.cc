// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/base/exceptions.h>

#include <ebsmpm/lac/amg_hierarchy.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace EBSMPM
{
  struct AmgHierarchy::Data
  {
    Data(const Epetra_CrsMatrix        &A,
         const unsigned int             block_size,
         const std::vector<LA::Vector> &near_null_space)
      : matrix(A)
      , null_space(A.RowMap(),
                   near_null_space.empty() ? block_size :
                                             near_null_space.size())
    {
      if (near_null_space.empty())
        for (int i = 0; i < null_space.MyLength(); ++i)
          null_space[A.GRID(i) % block_size][i] = 1.;
      else
        for (unsigned int v = 0; v < near_null_space.size(); ++v)
          {
            const Epetra_MultiVector &vector =
              near_null_space[v].trilinos_vector();
            Assert(vector.Map().SameAs(A.RowMap()),
                   ExcMessage("A vector of the near null space is not "
                              "distributed like the rows of the matrix."));
            std::copy(vector[0], vector[0] + vector.MyLength(), null_space[v]);
          }

      Teuchos::ParameterList list;
      ML_Epetra::SetDefaults("SA", list);
      list.set("ML output", 0);
      list.set("PDE equations", static_cast<int>(block_size));
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", null_space.NumVectors());
      list.set("null space: vectors", pointer_to_null_space());
      list.set("null space: add default vectors", false);

      list.set("aggregation: type", "Uncoupled");
      list.set("aggregation: threshold", 1e-3);
      list.set("smoother: type", "Chebyshev");
      list.set("smoother: sweeps", 2);
      list.set("smoother: Chebyshev alpha", 10.);
      list.set("coarse: type", "Amesos-KLU");
      list.set("coarse: max size", 1000);

      hierarchy =
        std::make_unique<ML_Epetra::MultiLevelPreconditioner>(matrix, list);
      AssertThrow(hierarchy->IsPreconditionerComputed(),
                  ExcSolverFailure("The multigrid hierarchy cannot be built."));
    }

    /**
     * Return where the vectors are, for ML expects them one behind the other. A
     * process without rows has none, but must not give a null pointer.
     */
    double *
    pointer_to_null_space()
    {
      return null_space.MyLength() > 0 ? null_space[0] : &dummy;
    }

    Epetra_CrsMatrix   matrix;
    Epetra_MultiVector null_space;
    double             dummy = 0.;

    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> hierarchy;
  };



  AmgHierarchy::AmgHierarchy() = default;



  AmgHierarchy::~AmgHierarchy() = default;



  void
  AmgHierarchy::set_block_size(const unsigned int size)
  {
    Assert(size > 0, ExcMessage("A block has one unknown at least."));
    block_size = size;
  }



  void
  AmgHierarchy::set_near_null_space(const std::vector<LA::Vector> &vectors)
  {
    // Assigned one by one, vectors of the same size would keep their former
    // distribution.
    near_null_space = std::vector<LA::Vector>(vectors);
  }



  void
  AmgHierarchy::initialize(const LA::SparseMatrix &A)
  {
    data.reset(); // releases its memory first
    data =
      std::make_unique<Data>(A.trilinos_matrix(), block_size, near_null_space);
  }



  void
  AmgHierarchy::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    const int error = data->hierarchy->ApplyInverse(src.trilinos_vector(),
                                                    dst.trilinos_vector());
    AssertThrow(error == 0,
                ExcSolverFailure("The multigrid cycle failed with the error " +
                                 std::to_string(error) + "."));
  }



  std::string
  AmgHierarchy::name() const
  {
    return "AMG";
  }
} // namespace EBSMPM
