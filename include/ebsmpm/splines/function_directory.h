// -----------------------------------------------------------------------------
//
// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the ebsmpm authors
//
// This file is part of the ebsmpm library.
//
// -----------------------------------------------------------------------------

#ifndef ebsmpm_splines_function_directory_h
#define ebsmpm_splines_function_directory_h

#include <ebsmpm/splines/function_key.h>

#include <deal.II/base/mpi.h>

#include <cstring>
#include <map>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace EBSMPM
{
  /**
   * A distributed table of B-spline functions: processes that know something
   * about the same function meet at a third one, the <em>home</em> of the
   * function, without anybody holding the whole table.
   *
   * One layer of ghost cells does not reach all functions that a process has to
   * know: the support of a function is $p+1$ cells wide, and a function may be
   * extrapolated from others that are further away still. Therefore, the hash
   * of the FunctionKey names the home, and three collective operations suffice:
   *
   * @code
   * FunctionDirectory<dim, double> directory(mpi_communicator);
   * // the sum of the contributions of all processes, for my own keys:
   * auto sums = directory.reduce(local, std::plus<double>());
   * // keep something for everybody, and ask for what others kept:
   * directory.publish(mine);
   * auto found = directory.query(keys);
   * @endcode
   *
   * @p Value must be trivially copyable for the messages to be quick. All
   * functions are collective, their cost is proportional to the number of keys
   * handed over, and the messages go to those processes only that are homes of
   * these.
   */
  template <int dim, typename Value>
  class FunctionDirectory
  {
  public:
    using Key = FunctionKey<dim>;

    /** A key and what is known about it; trivially copyable like both. */
    struct Entry
    {
      Key   key;
      Value value;
    };

    using Table = std::unordered_map<Key, Value, FunctionKeyHash<dim>>;

    /** Create an empty directory. */
    explicit FunctionDirectory(const MPI_Comm &communicator)
      : communicator(communicator)
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
    {}

    /** Forget everything that was published. */
    void
    clear()
    {
      home_table.clear();
    }

    /**
     * Combine the values that all processes give for the same key, and return
     * the result for the keys given here. The values are combined in the order
     * of the ranks by <tt>Value combine(Value, Value)</tt>. Nothing is kept.
     */
    template <typename Combine>
    Table
    reduce(const Table &local, const Combine &combine) const
    {
      if (n_ranks == 1)
        return local;

      std::map<unsigned int, std::vector<Entry>> outgoing;
      for (const auto &entry : local)
        outgoing[home(entry.first)].push_back({entry.first, entry.second});
      const auto incoming = exchange(outgoing);

      Table totals;
      for (const auto &message : incoming)
        for (const auto &entry : message.second)
          {
            const auto inserted = totals.emplace(entry.key, entry.value);
            if (!inserted.second)
              inserted.first->second =
                combine(inserted.first->second, entry.value);
          }

      std::map<unsigned int, std::vector<Entry>> answers;
      for (const auto &message : incoming)
        {
          auto &answer = answers[message.first];
          answer.reserve(message.second.size());
          for (const auto &entry : message.second)
            answer.push_back({entry.key, totals.at(entry.key)});
        }

      Table result;
      result.reserve(local.size());
      for (const auto &message : exchange(answers))
        for (const auto &entry : message.second)
          result.emplace(entry.key, entry.value);
      return result;
    }

    /**
     * Keep the given entries for everybody. Each key must come from one process
     * only.
     */
    void
    publish(const std::vector<Entry> &entries)
    {
      std::map<unsigned int, std::vector<Entry>> outgoing;
      for (const auto &entry : entries)
        outgoing[home(entry.key)].push_back(entry);
      for (const auto &message : exchange(outgoing))
        for (const auto &entry : message.second)
          home_table[entry.key] = entry.value;
    }

    /**
     * Return what was published about the given keys. Keys nobody published
     * something about are missing in the result.
     */
    Table
    query(const std::vector<Key> &keys) const
    {
      std::map<unsigned int, std::vector<Key>> questions;
      for (const auto &key : keys)
        questions[home(key)].push_back(key);

      std::map<unsigned int, std::vector<Entry>> answers;
      for (const auto &message : exchange(questions))
        {
          auto &answer = answers[message.first];
          for (const auto &key : message.second)
            {
              const auto found = home_table.find(key);
              if (found != home_table.end())
                answer.push_back({key, found->second});
            }
        }

      Table result;
      result.reserve(keys.size());
      for (const auto &message : exchange(answers))
        for (const auto &entry : message.second)
          result.emplace(entry.key, entry.value);
      return result;
    }

  private:
    /** The process that keeps the books about @p key. */
    unsigned int
    home(const Key &key) const
    {
      return FunctionKeyHash<dim>()(key) % n_ranks;
    }

    /**
     * Utilities::MPI::some_to_some() for arrays of trivially copyable objects,
     * which travel as bytes: serialisation object by object takes longer than
     * everything else here. Nothing is sent on a single process.
     */
    template <typename T>
    std::map<unsigned int, std::vector<T>>
    exchange(const std::map<unsigned int, std::vector<T>> &outgoing) const
    {
      static_assert(std::is_trivially_copyable<T>::value,
                    "Messages are sent as bytes.");
      if (n_ranks == 1)
        return outgoing;

      std::map<unsigned int, std::vector<char>> bytes;
      for (const auto &message : outgoing)
        {
          auto &buffer = bytes[message.first];
          buffer.resize(message.second.size() * sizeof(T));
          std::memcpy(buffer.data(), message.second.data(), buffer.size());
        }

      std::map<unsigned int, std::vector<T>> incoming;
      for (const auto &message :
           Utilities::MPI::some_to_some(communicator, bytes))
        {
          auto &objects = incoming[message.first];
          objects.resize(message.second.size() / sizeof(T));
          std::memcpy(static_cast<void *>(objects.data()),
                      message.second.data(),
                      message.second.size());
        }
      return incoming;
    }

    const MPI_Comm     communicator;
    const unsigned int n_ranks;

    /** What was published about the functions whose home is here. */
    Table home_table;
  };
} // namespace EBSMPM

#endif
