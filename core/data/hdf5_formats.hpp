// SPDX-License-Identifier: MIT
// The three kinds of HDF5 files that hold particles. reader_hdf5.cpp asks each whether a file is its own.
#pragma once

#include "core/data/hdf5_file.hpp"
#include "core/data/source.hpp"

#include <memory>

namespace mote::data {

// Nothing when the file is none of its kind; Failure when it is and is broken.
std::unique_ptr<Source> open_h5md(const std::shared_ptr<Hdf5File>& file);   // de Buyl et al. 2014, H5MD 1.1
std::unique_ptr<Source> open_gadget(const std::shared_ptr<Hdf5File>& file); // GADGET-2, -4, SWIFT, AREPO snapshots
std::unique_ptr<Source> open_vtkhdf(const std::shared_ptr<Hdf5File>& file); // VTKHDF 1 and 2: PolyData, UnstructuredGrid

} // namespace mote::data
