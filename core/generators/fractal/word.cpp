#include "core/generators/fractal/word.h"

#include <array>
#include <cstdint>

#include "core/base/math.h"

namespace seedmesh::fractal {
namespace {

constexpr int letter_width = 5, letter_height = 7;

struct Letter {
  char character;
  std::array<std::uint8_t, letter_height> rows;  ///< from the top; the leftmost dot is bit 4
};

constexpr Letter letters[] = {
    {' ', {0, 0, 0, 0, 0, 0, 0}},        {'0', {14, 17, 19, 21, 25, 17, 14}},
    {'1', {4, 12, 4, 4, 4, 4, 14}},      {'2', {14, 17, 1, 2, 4, 8, 31}},
    {'3', {31, 2, 4, 2, 1, 17, 14}},     {'4', {2, 6, 10, 18, 31, 2, 2}},
    {'5', {31, 16, 30, 1, 1, 17, 14}},   {'6', {6, 8, 16, 30, 17, 17, 14}},
    {'7', {31, 1, 2, 4, 8, 8, 8}},       {'8', {14, 17, 17, 14, 17, 17, 14}},
    {'9', {14, 17, 17, 15, 1, 2, 12}},   {'A', {14, 17, 17, 31, 17, 17, 17}},
    {'B', {30, 17, 17, 30, 17, 17, 30}}, {'C', {14, 17, 16, 16, 16, 17, 14}},
    {'D', {28, 18, 17, 17, 17, 18, 28}}, {'E', {31, 16, 16, 30, 16, 16, 31}},
    {'F', {31, 16, 16, 30, 16, 16, 16}}, {'G', {14, 17, 16, 23, 17, 17, 15}},
    {'H', {17, 17, 17, 31, 17, 17, 17}}, {'I', {14, 4, 4, 4, 4, 4, 14}},
    {'J', {7, 2, 2, 2, 2, 18, 12}},      {'K', {17, 18, 20, 24, 20, 18, 17}},
    {'L', {16, 16, 16, 16, 16, 16, 31}}, {'M', {17, 27, 21, 21, 17, 17, 17}},
    {'N', {17, 17, 25, 21, 19, 17, 17}}, {'O', {14, 17, 17, 17, 17, 17, 14}},
    {'P', {30, 17, 17, 30, 16, 16, 16}}, {'Q', {14, 17, 17, 17, 21, 18, 13}},
    {'R', {30, 17, 17, 30, 20, 18, 17}}, {'S', {15, 16, 16, 14, 1, 1, 30}},
    {'T', {31, 4, 4, 4, 4, 4, 4}},       {'U', {17, 17, 17, 17, 17, 17, 14}},
    {'V', {17, 17, 17, 17, 17, 10, 4}},  {'W', {17, 17, 17, 21, 21, 27, 17}},
    {'X', {17, 17, 10, 4, 10, 17, 17}},  {'Y', {17, 17, 10, 4, 4, 4, 4}},
    {'Z', {31, 1, 2, 4, 8, 16, 31}},
};

const Letter* find_letter(char character) {
  if (character >= 'a' && character <= 'z') character = static_cast<char>(character - 'a' + 'A');
  for (const Letter& letter : letters) {
    if (letter.character == character) return &letter;
  }
  return nullptr;
}

/// Blocks are rotated about Y by their column and about X by their row, so that neighbours look different.
glm::dmat3 turned(int column, int row) {
  const math::SinCos y = math::sincos_degrees(15.0 * column), x = math::sincos_degrees(10.0 * row);
  const glm::dmat3 about_y{{y.cos, 0, -y.sin}, {0, 1, 0}, {y.sin, 0, y.cos}};
  const glm::dmat3 about_x{{1, 0, 0}, {0, x.cos, x.sin}, {0, -x.sin, x.cos}};
  return about_y * about_x;
}

}  // namespace

bool has_letter(char character) { return find_letter(character) != nullptr; }

std::vector<Affine> word_maps(std::string_view text) {
  std::vector<Affine> maps;
  const int columns = static_cast<int>(text.size()) * (letter_width + 1) - 1;
  const double dot = 1.0 / columns;
  for (std::size_t index = 0; index < text.size(); ++index) {
    const Letter* letter = find_letter(text[index]);
    if (!letter) return {};
    for (int row = 0; row < letter_height; ++row) {
      for (int i = 0; i < letter_width; ++i) {
        if ((letter->rows[static_cast<std::size_t>(row)] >> (letter_width - 1 - i) & 1) == 0) continue;
        const int column = static_cast<int>(index) * (letter_width + 1) + i;
        const glm::dvec3 centre{(column + 0.5) * dot - 0.5, ((letter_height - 1) / 2.0 - row) * dot, 0};
        maps.push_back({turned(column, row) * (0.95 * dot), centre});
      }
    }
  }
  return maps;
}

}  // namespace seedmesh::fractal
