// SPDX-License-Identifier: MIT
// Texts that several writers of charts share. Private to core/chart.
#pragma once

#include <string>
#include <string_view>

namespace mote::chart {

std::string escaped(std::string_view text); // for XML and HTML
std::string number(double value);           // shortest that reads back the same; "inf", "nan"

} // namespace mote::chart
