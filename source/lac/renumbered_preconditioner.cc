// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#include <ebsmpm/lac/diagonal.h>
#include <ebsmpm/lac/renumbered_preconditioner.h>

namespace EBSMPM
{
  RenumberedPreconditioner::RenumberedPreconditioner(
    const ReusablePreconditioner &preconditioner,
    const IndexSet               &former_rows_owned,
    const LA::FieldVector        &former_rows,
    const LA::SparseMatrix       &A)
    : preconditioner(preconditioner)
    , former_src(former_rows_owned, A.get_mpi_communicator())
    , former_dst(former_src)
  {
    LA::Vector diagonal(A.locally_owned_range_indices(),
                        A.get_mpi_communicator());
    copy_diagonal(A, diagonal);

    std::vector<int> former_numbers;
    for (unsigned int i = 0; i < former_rows.locally_owned_size(); ++i)
      {
        const double former = former_rows.local_element(i);
        if (former > 0.)
          {
            known_rows.push_back(i);
            former_numbers.push_back(static_cast<int>(former) - 1);
          }
        else
          {
            new_rows.push_back(i);
            const double entry = diagonal.begin()[i];
            inverse_diagonal.push_back(entry > 0. ? 1. / entry : 1.);
          }
      }
    known_map =
      std::make_unique<Epetra_Map>(-1,
                                   former_numbers.size(),
                                   former_numbers.data(),
                                   0,
                                   former_src.trilinos_partitioner().Comm());
    to_former =
      std::make_unique<Epetra_Export>(*known_map,
                                      former_src.trilinos_partitioner());
    known = std::make_unique<Epetra_Vector>(*known_map, false);
  }



  void
  RenumberedPreconditioner::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    const double *const src_values = src.begin();
    double *const       dst_values = dst.begin();

    for (std::size_t k = 0; k < known_rows.size(); ++k)
      (*known)[k] = src_values[known_rows[k]];
    Epetra_MultiVector &former = former_src.trilinos_vector();
    former.PutScalar(0.);
    former.Export(*known, *to_former, Insert);

    preconditioner.vmult(former_dst, former_src);

    transfer(former_dst, dst);
    for (std::size_t k = 0; k < new_rows.size(); ++k)
      dst_values[new_rows[k]] = inverse_diagonal[k] * src_values[new_rows[k]];
  }



  void
  RenumberedPreconditioner::transfer(const LA::Vector &former,
                                     LA::Vector       &today) const
  {
    known->Import(former.trilinos_vector(), *to_former, Insert);
    double *const values = today.begin();
    for (std::size_t k = 0; k < known_rows.size(); ++k)
      values[known_rows[k]] = (*known)[k];
    for (const int row : new_rows)
      values[row] = 0.;
  }
} // namespace EBSMPM
