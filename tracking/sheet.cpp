// SPDX-License-Identifier: MIT
#include "tracking/sheet.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "tracking/tag_cells.hpp"

namespace slamscope::tracking {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kMargin = 10, kFooter = 16;  // mm

std::string numberText(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4f", value);
  return text.data();
}

/// What is drawn on one page; mm from its lower left corner.
class Page {
 public:
  void square(double x, double y, double width, double height) {
    content_ += numberText(x * kPointsPerMm) + " " + numberText(y * kPointsPerMm) + " " +
                numberText(width * kPointsPerMm) + " " + numberText(height * kPointsPerMm) +
                " re f\n";
  }
  void words(double x, double y, double height, const std::string& text) {
    content_ += "BT /F1 " + numberText(height * kPointsPerMm) + " Tf " +
                numberText(x * kPointsPerMm) + " " + numberText(y * kPointsPerMm) + " Td (" + text +
                ") Tj ET\n";
  }
  /// A tag, its black square's lower left corner at x, y.
  void tag(const TagCells& cells, double x, double y, double size) {
    const double cell = size / cells.across_black;
    const double left = x - cell * cells.border, top = y + size + cell * cells.border;
    for (int row = 0; row < cells.size; ++row) {
      for (int column = 0; column < cells.size;) {
        int end = column;
        while (end < cells.size && cells.black(end, row)) ++end;
        // One rectangle for a run: no hairlines between cells.
        if (end > column)
          square(left + column * cell, top - (row + 1) * cell, (end - column) * cell, cell);
        column = std::max(end, column + 1);
      }
    }
  }
  void scaleBar(const std::string& title) {
    square(kMargin, 6, 100, 0.6);
    square(kMargin, 5, 0.3, 2.6);
    square(kMargin + 99.7, 5, 0.3, 2.6);
    words(kMargin + 104, 5.2, 3.2, "100 mm: print without scaling");
    words(kMargin, 9, 3.2, title);
  }
  [[nodiscard]] const std::string& content() const { return content_; }

 private:
  std::string content_ = "0 g\n";
};

std::string sizeText(double mm) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g mm", mm);
  return text.data();
}

void requireFit(const SheetOptions& options, double width, double height) {
  const double room_x = options.paper_width_mm - 2 * kMargin;
  const double room_y = options.paper_height_mm - kMargin - kFooter;
  if (width <= room_x && height <= room_y) return;
  throw std::invalid_argument("sheet: " + sizeText(width) + " x " + sizeText(height) +
                              " does not fit the paper's " + sizeText(room_x) + " x " +
                              sizeText(room_y));
}

std::vector<Page> tagPages(const SheetOptions& options) {
  const double pitch_x = options.size_mm * 1.35, pitch_y = options.size_mm * 1.35 + 8;
  requireFit(options, pitch_x, pitch_y);
  const int columns = static_cast<int>((options.paper_width_mm - 2 * kMargin) / pitch_x);
  const int rows = static_cast<int>((options.paper_height_mm - kMargin - kFooter) / pitch_y);
  std::vector<Page> pages;
  for (int i = 0; i < options.count; ++i) {
    const int place = i % (columns * rows);
    if (place == 0) {
      pages.emplace_back();
      pages.back().scaleBar("slamscope tags " + options.family + ", black square " +
                            sizeText(options.size_mm));
    }
    const int id = options.first_id + i;
    const double x = kMargin + (place % columns) * pitch_x + 0.175 * options.size_mm;
    const double y =
        options.paper_height_mm - kMargin - (place / columns) * pitch_y - 1.175 * options.size_mm;
    pages.back().tag(tagCells(options.family, id), x, y, options.size_mm);
    pages.back().words(
        x, y - 0.175 * options.size_mm - 5, 4,
        options.family + "  id " + std::to_string(id) + "  " + sizeText(options.size_mm));
  }
  return pages;
}

std::vector<Page> gridPages(const SheetOptions& options) {
  const double pitch = options.size_mm * (1 + options.spacing);
  const double width = (options.columns - 1) * pitch + options.size_mm;
  const double height = (options.rows - 1) * pitch + options.size_mm;
  const double rim = options.size_mm / 8;  // of white, that the outer tags need
  requireFit(options, width + 2 * rim, height + 2 * rim);
  Page page;
  const double left = (options.paper_width_mm - width) / 2;
  const double bottom = kFooter + (options.paper_height_mm - kMargin - kFooter - height) / 2;
  for (int row = 0; row < options.rows; ++row) {
    for (int column = 0; column < options.columns; ++column) {
      const int id = options.first_id + row * options.columns + column;
      page.tag(tagCells(options.family, id), left + column * pitch,
               bottom + (options.rows - 1 - row) * pitch, options.size_mm);
    }
  }
  page.scaleBar("slamscope april grid " + options.family + ", " + std::to_string(options.columns) +
                " x " + std::to_string(options.rows) + " tags of " + sizeText(options.size_mm) +
                ", gaps " + sizeText(options.spacing * options.size_mm));
  return {page};
}

std::vector<Page> chessboardPages(const SheetOptions& options) {
  const int columns = options.columns + 1, rows = options.rows + 1;  // of squares
  requireFit(options, columns * options.size_mm, rows * options.size_mm);
  Page page;
  const double left = (options.paper_width_mm - columns * options.size_mm) / 2;
  const double bottom =
      kFooter + (options.paper_height_mm - kMargin - kFooter - rows * options.size_mm) / 2;
  for (int row = 0; row < rows; ++row) {
    for (int column = row % 2; column < columns; column += 2) {
      page.square(left + column * options.size_mm, bottom + row * options.size_mm, options.size_mm,
                  options.size_mm);
    }
  }
  page.scaleBar("slamscope chessboard, " + std::to_string(options.columns) + " x " +
                std::to_string(options.rows) + " inner corners, squares of " +
                sizeText(options.size_mm));
  return {page};
}

/// Objects, table of where they begin, trailer (ISO 32000-1, 7.5).
std::string assembled(const std::vector<Page>& pages, const SheetOptions& options) {
  std::vector<std::string> objects;
  std::string kids;
  for (std::size_t i = 0; i < pages.size(); ++i) kids += std::to_string(4 + 2 * i) + " 0 R ";
  objects.emplace_back("<< /Type /Catalog /Pages 2 0 R >>");
  objects.push_back("<< /Type /Pages /Count " + std::to_string(pages.size()) + " /Kids [" + kids +
                    "] >>");
  objects.emplace_back("<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>");
  for (std::size_t i = 0; i < pages.size(); ++i) {
    objects.push_back("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " +
                      numberText(options.paper_width_mm * kPointsPerMm) + " " +
                      numberText(options.paper_height_mm * kPointsPerMm) +
                      "] /Resources << /Font << /F1 3 0 R >> >> /Contents " +
                      std::to_string(5 + 2 * i) + " 0 R >>");
    const std::string& content = pages[i].content();
    objects.push_back("<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content +
                      "endstream");
  }
  std::string pdf = "%PDF-1.4\n", table;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    std::array<char, 24> entry{};
    std::snprintf(entry.data(), entry.size(), "%010zu 00000 n \n", pdf.size());
    table += entry.data();
    pdf += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::string size = std::to_string(objects.size() + 1), begin = std::to_string(pdf.size());
  return pdf + "xref\n0 " + size + "\n0000000000 65535 f \n" + table + "trailer << /Size " + size +
         " /Root 1 0 R >>\nstartxref\n" + begin + "\n%%EOF\n";
}

}  // namespace

std::string sheetPdf(const SheetOptions& options) {
  if (!(options.size_mm > 0)) throw std::invalid_argument("sheet: expected a size above 0 mm");
  if (options.kind == SheetKind::tags) {
    if (options.count < 1) throw std::invalid_argument("sheet: expected at least one tag");
    return assembled(tagPages(options), options);
  }
  if (options.columns < 1 || options.rows < 1) {
    throw std::invalid_argument("sheet: expected at least one column and row");
  }
  return assembled(
      options.kind == SheetKind::april_grid ? gridPages(options) : chessboardPages(options),
      options);
}

void writeSheet(const SheetOptions& options, const std::filesystem::path& file) {
  const std::string pdf = sheetPdf(options);
  std::ofstream out(file, std::ios::binary);
  out << pdf;
  if (!out.flush()) throw std::runtime_error(file.string() + ": can't be written");
}

}  // namespace slamscope::tracking
