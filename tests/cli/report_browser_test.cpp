// The report in a real browser: every chart drawn, nothing on the console, tables that sort, and how it looks. Headless
// Chromium; skipped where there is none (Debian: package chromium).
// To accept a new look: LAMPLIGHT_UPDATE_GOLDEN=1 test_cli --gtest_filter='ReportBrowser*', then look at the picture.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cli/cli_test.h"
#include "image/image.h"

namespace lamp::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Results of a real run that stand in the repository, so that the page is the same every time.
const fs::path GOLDEN = fs::path(LAMPLIGHT_SOURCE_DIR) / "tests/golden/report";

// What may differ between versions of fonts and browser: levels of 255, mean over the pixels.
constexpr double MEAN_LEVELS = 6.0;

// Looks at the page from inside, when it is built: sorts, toggles, and leaves what it saw as text.
constexpr const char* PROBE = R"(<script>
{
const column = name => {
  const table = document.querySelector('table');
  const heads = [...table.tHead.rows[0].cells];
  const place = heads.findIndex(head => head.textContent === name);
  heads[place].querySelector('button').click();
  return {sort: heads[place].getAttribute('aria-sort'), values: [...table.tBodies[0].rows].map(row => row.cells[place].textContent)};
};
const drawn = canvas => {
  const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  const colors = new Set();
  for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 200) colors.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
  return colors.size;
};
const seen = {};
seen.canvases = [...document.querySelectorAll('canvas')].map(canvas => ({label: canvas.getAttribute('aria-label'), colors: drawn(canvas),
  empty: Chart.getChart(canvas).data.datasets.every(set => set.data.length === 0)}));
seen.up = column('cull, ms');
seen.down = column('cull, ms');
seen.names = column('what');
seen.light = [document.documentElement.dataset.theme, getComputedStyle(document.body).backgroundColor];
document.getElementById('theme').click();
seen.dark = [document.documentElement.dataset.theme, getComputedStyle(document.body).backgroundColor];
const slider = document.querySelector('.compare input');
slider.value = 20;
slider.dispatchEvent(new Event('input'));
seen.clip = document.querySelector('.compare .over').style.clipPath;
seen.images = [...document.images].map(image => image.naturalWidth);
const menu = document.querySelector('.controls select');
menu.value = 'excess';
menu.dispatchEvent(new Event('change'));
seen.axis = Chart.getChart(document.querySelector('canvas')).options.scales.x.title.text;
const sweep = Chart.getChart(document.querySelector('canvas[aria-label="lights: cull and shade, ms"]'));
const gaps = axis => axis.ticks.slice(1).map((tick, i) => Math.abs(axis.getPixelForTick(i + 1) - axis.getPixelForTick(i)));
seen.gaps = [Math.min(...gaps(sweep.scales.x)), Math.min(...gaps(sweep.scales.y))];
const marker = sweep.getDatasetMeta(0).data[0];
const copy = Object.assign(document.createElement('canvas'), {width: 1, height: 1}).getContext('2d');
copy.drawImage(sweep.canvas, sweep.chartArea.left - 2, Math.round(marker.y), 1, 1, 0, 0, 1, 1);
seen.beside = [...copy.getImageData(0, 0, 1, 1).data];
seen.common = document.getElementById('series-0-lights').querySelector('.note').textContent;
seen.facts = document.querySelector('dl.facts').textContent;
seen.summary = [...document.querySelectorAll('.words li')].map(item => item.textContent);
document.body.append(Object.assign(document.createElement('pre'), {id: 'seen', textContent: btoa(unescape(encodeURIComponent(JSON.stringify(seen))))}));
}
</script></body>)";

std::string base64_decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0;
  int bits = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    word = (word << 6U | static_cast<unsigned>(digit)) & 0xFFFFFFU;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> static_cast<unsigned>(bits) & 0xFFU);
  }
  return bytes;
}

/// Its command, or nothing.
std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

class ReportBrowser : public CliTest {
 protected:
  void SetUp() override {
    if (browser().empty()) GTEST_SKIP() << "no Chromium here: install the package chromium to test the report";
    (void)output_of({"report", (GOLDEN / "results.json").string(), "--out", "report.html"});
  }

  /// Opens a page of the test's folder; what the browser prints. Console messages are failures.
  [[nodiscard]] std::string open(const std::string& page, const std::string& options) const {
    const std::string folder = path("").string();
    const std::string command = "HOME='" + folder + "' " + browser() +
                                " --headless --no-sandbox --disable-gpu --hide-scrollbars --force-device-scale-factor=1"
                                " --enable-logging=stderr --virtual-time-budget=10000 --user-data-dir='" +
                                folder + "profile' " + options + " 'file://" + folder + page + "' >'" + folder +
                                "out.txt' 2>'" + folder + "err.txt'";
    EXPECT_EQ(std::system(command.c_str()), 0) << read("err.txt");
    const std::string log = read("err.txt");
    for (const char* word : {"CONSOLE", "Uncaught"})
      EXPECT_EQ(log.find(word), std::string::npos) << log.substr(log.find(word), 500);
    return read("out.txt");
  }

  /// What the probe saw.
  [[nodiscard]] json probe() const {
    std::string page = read("report.html");
    page.replace(page.rfind("</body>"), 7, PROBE);
    write("probed.html", page);
    const std::string dom = open("probed.html", "--window-size=1300,1700 --dump-dom");
    const std::string mark = "<pre id=\"seen\">";
    const std::size_t at = dom.find(mark);
    if (at == std::string::npos) {
      ADD_FAILURE() << "the page's script did not come to its end";
      return json::object();
    }
    return json::parse(base64_decoded(dom.substr(at + mark.size())), nullptr, /* allow_exceptions= */ false);
  }
};

std::vector<double> numbers(const json& texts) {
  std::vector<double> values;
  for (const json& text : texts) {
    std::string digits = text.get<std::string>();
    std::erase(digits, ',');
    values.push_back(std::strtod(digits.c_str(), nullptr));
  }
  return values;
}

TEST_F(ReportBrowser, ChartsAreDrawnTablesSortAndEverythingIsThere) {
  const json seen = probe();
  ASSERT_TRUE(seen.contains("canvases"));
  EXPECT_EQ(seen.at("canvases").size(), 6U) << "bars, passes, sweep, passes, scatter, flight";
  for (const json& canvas : seen.at("canvases")) {
    EXPECT_GE(canvas.at("colors").get<int>(), 4) << canvas;
    EXPECT_FALSE(canvas.at("empty")) << canvas;
  }
  EXPECT_EQ(seen.at("up").at("sort"), "ascending");
  EXPECT_EQ(seen.at("down").at("sort"), "descending");
  const std::vector<double> up = numbers(seen.at("up").at("values"));
  const std::vector<double> down = numbers(seen.at("down").at("values"));
  ASSERT_GE(up.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(up));
  EXPECT_TRUE(std::ranges::is_sorted(down, std::greater{}));
  EXPECT_LT(up.front(), up.back());
  EXPECT_TRUE(std::ranges::is_sorted(seen.at("names").at("values")));
  EXPECT_EQ(seen.at("light")[0], "light");
  EXPECT_EQ(seen.at("dark")[0], "dark");
  EXPECT_NE(seen.at("light")[1], seen.at("dark")[1]);
  EXPECT_EQ(seen.at("clip"), "inset(0px 80% 0px 0px)");
  for (const json& width : seen.at("images")) EXPECT_GT(width.get<int>(), 0);
  EXPECT_EQ(seen.at("axis"), "excess (1 is perfect)");
  EXPECT_GE(seen.at("gaps")[0].get<double>(), 40.0) << "labels of the lights";
  EXPECT_GE(seen.at("gaps")[1].get<double>(), 16.0) << "labels of a logarithmic axis";
  EXPECT_EQ(seen.at("beside")[3], 255) << "the first marker is cut at the axis: " << seen.at("beside");
  EXPECT_NE(seen.at("common").get<std::string>().find("scene atrium, size 320x180, "), std::string::npos);
  for (const char* fact : {"command", "llvmpipe", "Mesa", "commit"})
    EXPECT_NE(seen.at("facts").get<std::string>().find(fact), std::string::npos) << fact;
  EXPECT_GE(seen.at("summary").size(), 5U);
}

TEST_F(ReportBrowser, ItLooksAsItDid) {
  (void)open("report.html", "--window-size=1300,1700 --screenshot='" + path("look.png").string() + "'");
  const app::LdrImage look = app::read_png(path("look.png"));
  const fs::path golden = GOLDEN / "report.png";
  if (std::getenv("LAMPLIGHT_UPDATE_GOLDEN") != nullptr) {
    app::write_png(golden, look);
    GTEST_SKIP() << "wrote " << golden << ": look at it";
  }
  const app::LdrImage wanted = app::read_png(golden);
  ASSERT_EQ(look.width, wanted.width);
  ASSERT_EQ(look.height, wanted.height);
  double sum = 0.0;
  for (std::size_t i = 0; i < look.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) sum += std::abs(look.pixels[i][c] - wanted.pixels[i][c]);
  EXPECT_LE(sum / (3.0 * static_cast<double>(look.pixels.size())), MEAN_LEVELS);
}

TEST_F(ReportBrowser, TwoRunsCompare) {
  const std::string file = (GOLDEN / "results.json").string();
  (void)output_of({"report", file, file, "--out", "two.html"});
  const std::string dom = open("two.html", "--dump-dom");
  EXPECT_NE(dom.find("B against A"), std::string::npos);
  EXPECT_NE(dom.find("configurations were timed in both runs; 0 in A alone, 0 in B alone"), std::string::npos);
}

}  // namespace
}  // namespace lamp::cli
