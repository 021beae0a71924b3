// SPDX-License-Identifier: MIT
#include "core/overlay/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::overlay {
namespace {

double power_of_ten(int e) { return std::pow(10.0, e); }

std::string raised(int e) {
  static const std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = e < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(e))) out += digits[static_cast<std::size_t>(c - '0')];
  return out;
}

// Rounded to `decimals`, a real minus in front.
std::string fixed(double value, int decimals) {
  std::string out = fmt::format("{:.{}f}", std::abs(value), std::max(decimals, 0));
  const bool zero = out.find_first_not_of("0.") == std::string::npos;
  return (value < 0.0 && !zero ? "−" : "") + out;
}

double round_step(double rough) {
  const double power = power_of_ten(static_cast<int>(std::floor(std::log10(rough))));
  for (const double m : {1.0, 2.0, 5.0})
    if (rough <= m * power * (1.0 + 1e-9)) return m * power;
  return 10.0 * power;
}

std::vector<Tick> logarithmic_ticks(double low, double high, int wanted) {
  std::vector<Tick> out;
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  const int stride = std::max(1, (last - first) / std::max(wanted, 1));
  const bool fine = last - first <= 2;
  for (int e = first; e <= last; e += stride)
    for (const double m : {1.0, 2.0, 5.0}) {
      const double value = m * power_of_ten(e);
      if ((m != 1.0 && !fine) || value < low * (1.0 - 1e-9) || value > high * (1.0 + 1e-9)) continue;
      out.push_back({value, number_label(value, 0.0)});
    }
  return out;
}

} // namespace

std::string number_label(double value, double step) {
  if (value == 0.0 || !std::isfinite(value)) return value == 0.0 ? "0" : fmt::format("{}", value);
  const double size = std::max(std::abs(value), step);
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  const int last_place = step > 0.0 ? static_cast<int>(std::floor(std::log10(step) + 1e-9)) : exponent - 2; // of the digits that count
  if (exponent < 5 && exponent > -4) {
    std::string text = fixed(value, -last_place);
    if (step == 0.0 && text.find('.') != std::string::npos) { // a number alone: no zeros at its end
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
    }
    return text;
  }
  const int own = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  std::string mantissa = fixed(value / power_of_ten(own), std::clamp(own - last_place, 0, 6));
  if (mantissa.find('.') != std::string::npos) {
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.back() == '.') mantissa.pop_back();
  }
  if (mantissa == "1") return "10" + raised(own);
  return mantissa + "×10" + raised(own);
}

std::vector<Tick> ticks(double low, double high, int wanted, bool logarithmic) {
  if (low > high) std::swap(low, high);
  if (!(std::isfinite(low) && std::isfinite(high)) || (logarithmic && !(low > 0.0))) return {};
  if (low == high) return {{low, number_label(low, 0.0)}};
  if (logarithmic) {
    std::vector<Tick> out = logarithmic_ticks(low, high, wanted);
    if (out.size() >= 2) return out;
  }
  const double step = round_step((high - low) / std::max(wanted, 1));
  std::vector<Tick> out;
  const double first = std::ceil(low / step - 1e-9);
  for (double k = first; k * step <= high + 1e-9 * step && out.size() < 100; ++k) out.push_back({k * step, number_label(k * step, step)});
  return out;
}

double round_length(double longest) {
  if (!(longest > 0.0 && std::isfinite(longest))) return 0.0;
  const double power = power_of_ten(static_cast<int>(std::floor(std::log10(longest))));
  for (const double m : {5.0, 2.0})
    if (m * power <= longest * (1.0 + 1e-9)) return m * power;
  return power <= longest * (1.0 + 1e-9) ? power : power / 2.0;
}

std::string unit_label(std::string_view unit) {
  if (unit == "A/m") return "A/m"; // amperes: of magnetization
  std::string out;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool alone = (i == 0 || !std::isalpha(static_cast<unsigned char>(unit[i - 1]))) && (i + 1 == unit.size() || !std::isalpha(static_cast<unsigned char>(unit[i + 1])));
    if (unit[i] == 'A' && alone) out += "Å";
    else if (unit[i] == '^' && i + 1 < unit.size() && (unit[i + 1] == '2' || unit[i + 1] == '3')) out += unit[++i] == '2' ? "²" : "³";
    else if (unit[i] == 'u' && i == 0 && unit.substr(1) == "m") out += "µ";
    else out += unit[i];
  }
  return out;
}

} // namespace mote::overlay
