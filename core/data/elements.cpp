// SPDX-License-Identifier: MIT
#include "core/data/elements.hpp"

#include "core/data/text.hpp"

#include <algorithm>
#include <array>

namespace mote::data {
namespace {

// Number, symbol, name, mass (u), radii (A; 0 = not known): covalent (B. Cordero et al., Dalton Trans.
// 2008, 2832; carbon sp3, manganese, iron and cobalt low spin), van der Waals (A. Bondi, J. Phys. Chem.
// 68, 441, 1964) and van der Waals (S. Alvarez, Dalton Trans. 2013, 8617); Jmol's color, sRGB-encoded
// (jmol.sourceforge.net/jscolors; 0xff1493 where Jmol has none). Masses: IUPAC standard atomic weights,
// for elements without one the mass of a long-lived isotope. The values are facts from these papers.
constexpr std::array<Element, 118> table{{
    {1, "H", "Hydrogen", 1.0080, 0.31f, 1.2f, 1.2f, 0xffffff},
    {2, "He", "Helium", 4.0026, 0.28f, 1.4f, 1.43f, 0xd9ffff},
    {3, "Li", "Lithium", 6.9400, 1.28f, 1.82f, 2.12f, 0xcc80ff},
    {4, "Be", "Beryllium", 9.0122, 0.96f, 1.53f, 1.98f, 0xc2ff00},
    {5, "B", "Boron", 10.8100, 0.84f, 1.92f, 1.91f, 0xffb5b5},
    {6, "C", "Carbon", 12.0110, 0.76f, 1.7f, 1.77f, 0x909090},
    {7, "N", "Nitrogen", 14.0070, 0.71f, 1.55f, 1.66f, 0x3050f8},
    {8, "O", "Oxygen", 15.9990, 0.66f, 1.52f, 1.5f, 0xff0d0d},
    {9, "F", "Fluorine", 18.9984, 0.57f, 1.47f, 1.46f, 0x90e050},
    {10, "Ne", "Neon", 20.1797, 0.58f, 1.54f, 1.58f, 0xb3e3f5},
    {11, "Na", "Sodium", 22.9898, 1.66f, 2.27f, 2.5f, 0xab5cf2},
    {12, "Mg", "Magnesium", 24.3050, 1.41f, 1.73f, 2.51f, 0x8aff00},
    {13, "Al", "Aluminium", 26.9815, 1.21f, 1.84f, 2.25f, 0xbfa6a6},
    {14, "Si", "Silicon", 28.0850, 1.11f, 2.1f, 2.19f, 0xf0c8a0},
    {15, "P", "Phosphorus", 30.9738, 1.07f, 1.8f, 1.9f, 0xff8000},
    {16, "S", "Sulfur", 32.0600, 1.05f, 1.8f, 1.89f, 0xffff30},
    {17, "Cl", "Chlorine", 35.4500, 1.02f, 1.75f, 1.82f, 0x1ff01f},
    {18, "Ar", "Argon", 39.9480, 1.06f, 1.88f, 1.83f, 0x80d1e3},
    {19, "K", "Potassium", 39.0983, 2.03f, 2.75f, 2.73f, 0x8f40d4},
    {20, "Ca", "Calcium", 40.0780, 1.76f, 2.31f, 2.62f, 0x3dff00},
    {21, "Sc", "Scandium", 44.9559, 1.7f, 0.0f, 2.58f, 0xe6e6e6},
    {22, "Ti", "Titanium", 47.8670, 1.6f, 0.0f, 2.46f, 0xbfc2c7},
    {23, "V", "Vanadium", 50.9415, 1.53f, 0.0f, 2.42f, 0xa6a6ab},
    {24, "Cr", "Chromium", 51.9961, 1.39f, 0.0f, 2.45f, 0x8a99c7},
    {25, "Mn", "Manganese", 54.9380, 1.39f, 0.0f, 2.45f, 0x9c7ac7},
    {26, "Fe", "Iron", 55.8450, 1.32f, 0.0f, 2.44f, 0xe06633},
    {27, "Co", "Cobalt", 58.9332, 1.26f, 0.0f, 2.4f, 0xf090a0},
    {28, "Ni", "Nickel", 58.6934, 1.24f, 1.63f, 2.4f, 0x50d050},
    {29, "Cu", "Copper", 63.5460, 1.32f, 1.4f, 2.38f, 0xc88033},
    {30, "Zn", "Zinc", 65.3800, 1.22f, 1.39f, 2.39f, 0x7d80b0},
    {31, "Ga", "Gallium", 69.7230, 1.22f, 1.87f, 2.32f, 0xc28f8f},
    {32, "Ge", "Germanium", 72.6300, 1.2f, 2.11f, 2.29f, 0x668f8f},
    {33, "As", "Arsenic", 74.9216, 1.19f, 1.85f, 1.88f, 0xbd80e3},
    {34, "Se", "Selenium", 78.9710, 1.2f, 1.9f, 1.82f, 0xffa100},
    {35, "Br", "Bromine", 79.9040, 1.2f, 1.85f, 1.86f, 0xa62929},
    {36, "Kr", "Krypton", 83.7980, 1.16f, 2.02f, 2.25f, 0x5cb8d1},
    {37, "Rb", "Rubidium", 85.4678, 2.2f, 3.03f, 3.21f, 0x702eb0},
    {38, "Sr", "Strontium", 87.6200, 1.95f, 2.49f, 2.84f, 0x00ff00},
    {39, "Y", "Yttrium", 88.9058, 1.9f, 0.0f, 2.75f, 0x94ffff},
    {40, "Zr", "Zirconium", 91.2240, 1.75f, 0.0f, 2.52f, 0x94e0e0},
    {41, "Nb", "Niobium", 92.9064, 1.64f, 0.0f, 2.56f, 0x73c2c9},
    {42, "Mo", "Molybdenum", 95.9500, 1.54f, 0.0f, 2.45f, 0x54b5b5},
    {43, "Tc", "Technetium", 97.9072, 1.47f, 0.0f, 2.44f, 0x3b9e9e},
    {44, "Ru", "Ruthenium", 101.0700, 1.46f, 0.0f, 2.46f, 0x248f8f},
    {45, "Rh", "Rhodium", 102.9055, 1.42f, 0.0f, 2.44f, 0x0a7d8c},
    {46, "Pd", "Palladium", 106.4200, 1.39f, 1.63f, 2.15f, 0x006985},
    {47, "Ag", "Silver", 107.8682, 1.45f, 1.72f, 2.53f, 0xc0c0c0},
    {48, "Cd", "Cadmium", 112.4140, 1.44f, 1.58f, 2.49f, 0xffd98f},
    {49, "In", "Indium", 114.8180, 1.42f, 1.93f, 2.43f, 0xa67573},
    {50, "Sn", "Tin", 118.7100, 1.39f, 2.17f, 2.42f, 0x668080},
    {51, "Sb", "Antimony", 121.7600, 1.39f, 2.06f, 2.47f, 0x9e63b5},
    {52, "Te", "Tellurium", 127.6000, 1.38f, 2.06f, 1.99f, 0xd47a00},
    {53, "I", "Iodine", 126.9045, 1.39f, 1.98f, 2.04f, 0x940094},
    {54, "Xe", "Xenon", 131.2930, 1.4f, 2.16f, 2.06f, 0x429eb0},
    {55, "Cs", "Caesium", 132.9055, 2.44f, 3.43f, 3.48f, 0x57178f},
    {56, "Ba", "Barium", 137.3270, 2.15f, 2.49f, 3.03f, 0x00c900},
    {57, "La", "Lanthanum", 138.9055, 2.07f, 0.0f, 2.98f, 0x70d4ff},
    {58, "Ce", "Cerium", 140.1160, 2.04f, 0.0f, 2.88f, 0xffffc7},
    {59, "Pr", "Praseodymium", 140.9077, 2.03f, 0.0f, 2.92f, 0xd9ffc7},
    {60, "Nd", "Neodymium", 144.2420, 2.01f, 0.0f, 2.95f, 0xc7ffc7},
    {61, "Pm", "Promethium", 144.9128, 1.99f, 0.0f, 0.0f, 0xa3ffc7},
    {62, "Sm", "Samarium", 150.3600, 1.98f, 0.0f, 2.9f, 0x8fffc7},
    {63, "Eu", "Europium", 151.9640, 1.98f, 0.0f, 2.87f, 0x61ffc7},
    {64, "Gd", "Gadolinium", 157.2500, 1.96f, 0.0f, 2.83f, 0x45ffc7},
    {65, "Tb", "Terbium", 158.9254, 1.94f, 0.0f, 2.79f, 0x30ffc7},
    {66, "Dy", "Dysprosium", 162.5000, 1.92f, 0.0f, 2.87f, 0x1fffc7},
    {67, "Ho", "Holmium", 164.9303, 1.92f, 0.0f, 2.81f, 0x00ff9c},
    {68, "Er", "Erbium", 167.2590, 1.89f, 0.0f, 2.83f, 0x00e675},
    {69, "Tm", "Thulium", 168.9342, 1.9f, 0.0f, 2.79f, 0x00d452},
    {70, "Yb", "Ytterbium", 173.0540, 1.87f, 0.0f, 2.8f, 0x00bf38},
    {71, "Lu", "Lutetium", 174.9668, 1.87f, 0.0f, 2.74f, 0x00ab24},
    {72, "Hf", "Hafnium", 178.4900, 1.75f, 0.0f, 2.63f, 0x4dc2ff},
    {73, "Ta", "Tantalum", 180.9479, 1.7f, 0.0f, 2.53f, 0x4da6ff},
    {74, "W", "Tungsten", 183.8400, 1.62f, 0.0f, 2.57f, 0x2194d6},
    {75, "Re", "Rhenium", 186.2070, 1.51f, 0.0f, 2.49f, 0x267dab},
    {76, "Os", "Osmium", 190.2300, 1.44f, 0.0f, 2.48f, 0x266696},
    {77, "Ir", "Iridium", 192.2170, 1.41f, 0.0f, 2.41f, 0x175487},
    {78, "Pt", "Platinum", 195.0840, 1.36f, 1.75f, 2.29f, 0xd0d0e0},
    {79, "Au", "Gold", 196.9666, 1.36f, 1.66f, 2.32f, 0xffd123},
    {80, "Hg", "Mercury", 200.5920, 1.32f, 1.55f, 2.45f, 0xb8b8d0},
    {81, "Tl", "Thallium", 204.3800, 1.45f, 1.96f, 2.47f, 0xa6544d},
    {82, "Pb", "Lead", 207.2000, 1.46f, 2.02f, 2.6f, 0x575961},
    {83, "Bi", "Bismuth", 208.9804, 1.48f, 2.07f, 2.54f, 0x9e4fb5},
    {84, "Po", "Polonium", 208.9824, 1.4f, 1.97f, 0.0f, 0xab5c00},
    {85, "At", "Astatine", 209.9872, 1.5f, 2.02f, 0.0f, 0x754f45},
    {86, "Rn", "Radon", 222.0176, 1.5f, 2.2f, 0.0f, 0x428296},
    {87, "Fr", "Francium", 223.0197, 2.6f, 3.48f, 0.0f, 0x420066},
    {88, "Ra", "Radium", 226.0254, 2.21f, 2.83f, 0.0f, 0x007d00},
    {89, "Ac", "Actinium", 227.0277, 2.15f, 0.0f, 2.8f, 0x70abfa},
    {90, "Th", "Thorium", 232.0377, 2.06f, 0.0f, 2.93f, 0x00baff},
    {91, "Pa", "Protactinium", 231.0359, 2.0f, 0.0f, 2.88f, 0x00a1ff},
    {92, "U", "Uranium", 238.0289, 1.96f, 1.86f, 2.71f, 0x008fff},
    {93, "Np", "Neptunium", 237.0482, 1.9f, 0.0f, 2.82f, 0x0080ff},
    {94, "Pu", "Plutonium", 244.0642, 1.87f, 0.0f, 2.81f, 0x006bff},
    {95, "Am", "Americium", 243.0614, 1.8f, 0.0f, 2.83f, 0x545cf2},
    {96, "Cm", "Curium", 247.0703, 1.69f, 0.0f, 3.05f, 0x785ce3},
    {97, "Bk", "Berkelium", 247.0703, 0.0f, 0.0f, 3.4f, 0x8a4fe3},
    {98, "Cf", "Californium", 251.0796, 0.0f, 0.0f, 3.05f, 0xa136d4},
    {99, "Es", "Einsteinium", 252.0830, 0.0f, 0.0f, 2.7f, 0xb31fd4},
    {100, "Fm", "Fermium", 257.0951, 0.0f, 0.0f, 0.0f, 0xb31fba},
    {101, "Md", "Mendelevium", 258.0984, 0.0f, 0.0f, 0.0f, 0xb30da6},
    {102, "No", "Nobelium", 259.1010, 0.0f, 0.0f, 0.0f, 0xbd0d87},
    {103, "Lr", "Lawrencium", 262.1100, 0.0f, 0.0f, 0.0f, 0xc70066},
    {104, "Rf", "Rutherfordium", 267.1220, 0.0f, 0.0f, 0.0f, 0xcc0059},
    {105, "Db", "Dubnium", 268.1260, 0.0f, 0.0f, 0.0f, 0xd1004f},
    {106, "Sg", "Seaborgium", 271.1340, 0.0f, 0.0f, 0.0f, 0xd90045},
    {107, "Bh", "Bohrium", 270.1330, 0.0f, 0.0f, 0.0f, 0xe00038},
    {108, "Hs", "Hassium", 269.1338, 0.0f, 0.0f, 0.0f, 0xe6002e},
    {109, "Mt", "Meitnerium", 278.1560, 0.0f, 0.0f, 0.0f, 0xeb0026},
    {110, "Ds", "Darmstadtium", 281.1650, 0.0f, 0.0f, 0.0f, 0xff1493},
    {111, "Rg", "Roentgenium", 281.1660, 0.0f, 0.0f, 0.0f, 0xff1493},
    {112, "Cn", "Copernicium", 285.1770, 0.0f, 0.0f, 0.0f, 0xff1493},
    {113, "Nh", "Nihonium", 286.1820, 0.0f, 0.0f, 0.0f, 0xff1493},
    {114, "Fl", "Flerovium", 289.1900, 0.0f, 0.0f, 0.0f, 0xff1493},
    {115, "Mc", "Moscovium", 289.1940, 0.0f, 0.0f, 0.0f, 0xff1493},
    {116, "Lv", "Livermorium", 293.2040, 0.0f, 0.0f, 0.0f, 0xff1493},
    {117, "Ts", "Tennessine", 293.2080, 0.0f, 0.0f, 0.0f, 0xff1493},
    {118, "Og", "Oganesson", 294.2140, 0.0f, 0.0f, 0.0f, 0xff1493},
}};

// OVITO's list of colors for particle types without a name (sRGB-encoded), used in turn.
constexpr std::array<std::uint32_t, 9> type_colors{0xff6666, 0x6666ff, 0xffba19, 0x787878, 0xd6bc27,
                                                   0xff66ff, 0xb300ff, 0x33ffff, 0x66ff66};

const Element* by_symbol(std::string_view symbol) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Element& e) { return e.symbol == symbol; });
  return found == table.end() ? nullptr : &*found;
}

constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

} // namespace

std::span<const Element> elements() { return table; }

const Element* element(std::int64_t number) {
  return number >= 1 && number <= static_cast<std::int64_t>(table.size())
             ? &table[static_cast<std::size_t>(number - 1)]
             : nullptr;
}

const Element* find_element(std::string_view label) {
  std::size_t letters = 0;
  while (letters < label.size() && is_letter(label[letters])) ++letters;
  if (letters == 0 || letters > 2) return nullptr;
  constexpr std::string_view allowed = "0123456789+-_*'.";
  if (label.find_first_not_of(allowed, letters) != std::string_view::npos) return nullptr;
  const std::string_view symbol = label.substr(0, letters);
  if (const Element* found = by_symbol(symbol)) return found;
  std::string usual = lower(symbol);
  usual[0] = static_cast<char>(usual[0] - 'a' + 'A');
  if (usual == "D" || usual == "T") return by_symbol("H");
  return by_symbol(usual);
}

std::uint32_t type_color(std::int64_t type) {
  const std::int64_t count = static_cast<std::int64_t>(type_colors.size());
  const std::int64_t turn = ((type % count) + count - 1) % count;
  return type_colors[static_cast<std::size_t>(turn)];
}

} // namespace mote::data
