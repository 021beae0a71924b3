// SPDX-License-Identifier: MIT
// HDF5: recognized by its magic word in every build, read where the HDF5 library was there at build time (MOTE_HDF5):
// H5MD, GADGET snapshots, VTKHDF. What kind it is says its groups, not its name.
#include "core/data/codes_molecular.hpp"
#include "core/data/registry.hpp"

#ifdef MOTE_HDF5
#include "core/data/hdf5_formats.hpp"
#endif

namespace mote::data {
namespace {

Sureness probe(const Probe& file) { return file.head.starts_with("\x89HDF\r\n\x1a\n") ? Sureness::Certain : Sureness::No; }

std::unique_ptr<Source> make(std::shared_ptr<Bytes> bytes) {
  const SourceLoc place{bytes->name()};
#ifdef MOTE_HDF5
  const auto file = std::make_shared<Hdf5File>(std::move(bytes));
  for (const auto open : {open_h5md, open_gadget, open_vtkhdf})
    if (auto source = open(file)) return source;
  fail(Exit::BadInput, molecule_code::variant, place, "the HDF5 file is none of those that are read",
       {"H5MD (/h5md, /particles), GADGET (/PartType0/Coordinates), VTKHDF (/VTKHDF/Points)"});
#else
  fail(Exit::BadInput, molecule_code::variant, place, "this is an HDF5 file, and this build of mote has no HDF5",
       {"Build with -DMOTE_HDF5=ON and libhdf5-dev installed"});
#endif
}

} // namespace

Reader hdf5_reader() {
  return {{"hdf5", "H5MD, GADGET and VTKHDF (in builds with MOTE_HDF5)", "h5 h5md hdf5 hdf vtkhdf"}, probe, make};
}

} // namespace mote::data
