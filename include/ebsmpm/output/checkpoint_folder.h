// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_output_checkpoint_folder_h
#define ebsmpm_output_checkpoint_folder_h

#include <ebsmpm/base/config.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace EBSMPM
{
  /**
   * The place where a run keeps its last checkpoint, such that there is a whole
   * one at any time, whenever the run is killed.
   *
   * What a checkpoint consists of is for others to decide; here, it is a folder
   * of files:
   * @code
   * checkpoint/step_00010/    the last one: complete, never touched again
   * checkpoint/new/           the next one, if the run was killed just then
   * @endcode
   * The files are written into the folder <tt>new</tt>, which is renamed when
   * all processes are done; only then the checkpoints of earlier steps go away.
   *
   * @code
   * CheckpointFolder checkpoints(directory + "/checkpoint", communicator);
   * const std::string folder = checkpoints.begin();
   * write(folder + "/state");
   * checkpoints.finish(n_step);
   * ...
   * const unsigned int step = checkpoints.last_step();
   * if (step != numbers::invalid_unsigned_int)
   *   read(checkpoints.folder(step) + "/state");
   * @endcode
   *
   * All functions are collective, except for folder(). Only the first process
   * changes folders; what goes wrong, such as a full disk, is thrown on all, as
   * ExcFile.
   */
  class CheckpointFolder
  {
  public:
    /**
     * Constructor. Nothing is looked at or written. @p directory need not
     * exist.
     */
    CheckpointFolder(const std::string &directory, const MPI_Comm communicator);

    /**
     * Return the step of the last checkpoint that is complete;
     * numbers::invalid_unsigned_int if there is none.
     */
    unsigned int
    last_step() const;

    /** Return the name of the folder of the checkpoint of a step. */
    std::string
    folder(const unsigned int step) const;

    /**
     * Make an empty folder for the files of a new checkpoint, and return its
     * name.
     */
    std::string
    begin() const;

    /**
     * Say that all files of this process are there. Once all processes have
     * said so, the folder becomes the checkpoint of @p step, and all others are
     * removed.
     */
    void
    finish(const unsigned int step) const;

    /** Remove all checkpoints. */
    void
    clear() const;

  private:
    const std::string directory;
    const MPI_Comm    communicator;
  };
} // namespace EBSMPM

#endif
