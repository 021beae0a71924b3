// SPDX-License-Identifier: MIT
// From what a user says (SceneDesc) to what is drawn (Scene): reads the particle files, gives each
// particle its radius and color, leaves out what cannot be drawn and says how much that was, and
// completes the camera.
//
// Radius, first that applies: the scene's own; the file's `radius`; the van der Waals radius of the element
// (Bondi, for metals Alvarez; Angstrom, or nm where the positions are nm); half the median distance of nearest
// neighbors; 0.5 where no two particles differ.
// Color, first that applies: the scene's own; the file's `color`; Jmol's color of the element; OVITO's color of the
// type; 0.8 gray (linear). File and table colors are sRGB-encoded.
#pragma once

#include "core/data/dataset.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_file.hpp"

namespace mote {

// Reads the frame of every data set that the scene names, or the first. Problems go to `diagnostics` (also those of the readers); with errors the scene is
// incomplete and must not be drawn. `size` is that of the picture: an automatic camera depends on its shape.
Scene realize(const SceneDesc& desc, Size2d size, Diagnostics& diagnostics);

class SceneSource;
// The same with files that are open already, at frame `index` of the series; nothing: each file's first frame, alone.
// With an index, camera and ranges are those of the series.
Scene realize(const SceneDesc& desc, Size2d size, SceneSource& source, std::optional<std::uint64_t> index, Diagnostics& diagnostics);

// `scene` as realize() made it of a description that differs from `desc` in the transforms of data sets only: instances, bounds and
// cells anew, the same to the bit as from realize(); particles and camera stay. False with errors in `diagnostics`: nothing is changed.
bool place_again(Scene& scene, const SceneDesc& desc, SceneSource& source, std::optional<std::uint64_t> index, Diagnostics& diagnostics);

// The camera of a scene whose data has these bounds: absent numbers are chosen so that all of it is in view.
Camera complete_camera(const CameraDesc& desc, const Bounds& bounds, Size2d size);

} // namespace mote
