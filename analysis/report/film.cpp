#include "analysis/report/film.hpp"

#include <fmt/format.h>
#include <glib.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "analysis/report/headless_browser.hpp"
#include "common/draft_file.hpp"
#include "common/shell_word.hpp"
#include "common/text_file.hpp"

namespace dipper::analysis::report {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 1280, kHeight = 720, kPerSecond = 15;
constexpr std::chrono::seconds kLoading{120}, kPicture{60};

std::string bytes_of_data_url(const std::string& url) {
  const auto comma = url.find(',');
  if (comma == std::string::npos) throw std::runtime_error("the page gives no picture");
  gsize size = 0;
  guchar* bytes = g_base64_decode(url.c_str() + comma + 1, &size);
  std::string out(reinterpret_cast<char*>(bytes), size);
  g_free(bytes);
  return out;
}

/// During its lifetime a write to a program that has ended returns an error, not a signal.
struct BrokenPipesAreErrors {
  void (*before)(int) = std::signal(SIGPIPE, SIG_IGN);
  ~BrokenPipesAreErrors() { std::signal(SIGPIPE, before); }
};

/// Takes pictures; closing it writes the film.
class Ffmpeg {
 public:
  explicit Ffmpeg(const fs::path& film) : film_(film), draft_(film) {
    const std::string command = fmt::format(
        "exec ffmpeg -loglevel error -y -f image2pipe -c:v mjpeg -framerate {} -i - -c:v libx264 "
        "-pix_fmt yuv420p -crf 21 -movflags +faststart {}",
        kPerSecond, shell_word(draft_.path()));
    pipe_ = popen(command.c_str(), "we");
    if (pipe_ == nullptr) throw std::runtime_error("ffmpeg cannot be started");
  }
  ~Ffmpeg() {
    if (pipe_ != nullptr) pclose(pipe_);
  }
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  void add(const std::string& jpeg) {
    if (std::fwrite(jpeg.data(), 1, jpeg.size(), pipe_) != jpeg.size()) fail();
  }
  void close() {
    FILE* pipe = pipe_;
    pipe_ = nullptr;
    if (pclose(pipe) != 0) fail();
    draft_.keep();
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error(film_.string() + ": ffmpeg cannot write it; its message is above");
  }

  fs::path film_;
  DraftFile draft_;
  FILE* pipe_ = nullptr;
};

/// A page whose replay is unpacked, ready to draw pictures.
class Projector {
 public:
  Projector(const fs::path& browser, const fs::path& page) : browser_(browser, page) {
    const nlohmann::json span = browser_.evaluate(R"js(new Promise((done, fail) => {
      const wait = () => {
        const d = window.dipper;
        if (d && !d.frames) fail(Error('it has no replay'));
        else if (d && d.frames.ready === d.clock.times.length && document.querySelector('canvas').film)
          done([d.clock.times[0], d.clock.end]);
        else setTimeout(wait, 50);
      };
      wait();
    }))js",
                                                  kLoading);
    start_s = span.at(0);
    end_s = span.at(1);
  }

  std::string picture(double time_s, const char* type) {
    return bytes_of_data_url(
        browser_.evaluate(fmt::format("document.querySelector('canvas').film({}, {}, {}, '{}')",
                                      time_s, kWidth, kHeight, type),
                          kPicture));
  }

  /// The time at which the dipper holds most before the swing of the first pass; else the middle.
  double fullest_s() {
    return browser_.evaluate(R"js((() => {
      const { model, clock } = window.dipper, load = model.channel('rock/mass_in_dipper'), { time_s } = model.curves;
      const dig = model.phases.find((p) => p.name === 'breakout') ?? model.phases.find((p) => p.name === 'fill');
      if (!load || !dig) return (clock.times[0] + clock.end) / 2;
      let best = dig.from, most = -1;
      time_s.forEach((t, k) => { if (dig.from <= t && t <= dig.to && load[k] > most) [most, best] = [load[k], t]; });
      return best;
    })())js",
                             kPicture);
  }

  double start_s = 0, end_s = 0;

 private:
  HeadlessBrowser browser_;
};

bool is_png(const fs::path& file) { return file.extension() == ".png"; }

}  // namespace

std::string film_obstacle(const FilmOptions& options) {
  if (!options.any()) return "";
  if (!options.video.empty() && options.video.extension() != ".mp4")
    return options.video.string() + ": a video is an .mp4";
  if (!options.poster.empty() && !is_png(options.poster) && options.poster.extension() != ".jpg")
    return options.poster.string() + ": a poster is a .png or a .jpg";
  for (const fs::path& file : {options.video, options.poster}) {
    if (file.empty()) continue;
    const fs::path folder = fs::absolute(file).parent_path();
    if (!fs::is_directory(folder) || access(folder.c_str(), W_OK | X_OK) != 0)
      return folder.string() + ": cannot be written into";
  }
  if (!find_browser())
    return "--video and --poster need a browser, and none was found: install chromium "
           "(apt-get "
           "install chromium)";
  if (!options.video.empty() && !program_on_path("ffmpeg"))
    return "--video needs ffmpeg, which was not found: apt-get install ffmpeg";
  return "";
}

void write_film(const fs::path& page, const FilmOptions& options, Reporter& reporter) {
  const BrokenPipesAreErrors while_it_draws;
  Projector projector(*find_browser(), page);
  if (!options.poster.empty()) {
    write_text(options.poster,
               projector.picture(projector.fullest_s(),
                                 is_png(options.poster) ? "image/png" : "image/jpeg"));
    reporter.line(options.poster.string());
  }
  if (options.video.empty()) return;
  const double span = projector.end_s - projector.start_s;
  const double faster = std::max(1.0, std::ceil(span * kPerSecond / kFilmPictures));
  const int count = static_cast<int>(span * kPerSecond / faster) + 1;
  Ffmpeg ffmpeg(options.video);
  for (int k = 0; k < count; ++k) {
    ffmpeg.add(projector.picture(projector.start_s + k * faster / kPerSecond, "image/jpeg"));
    reporter.progress(fmt::format("video: picture {} of {}", k + 1, count));
  }
  ffmpeg.close();
  reporter.line(
      fmt::format("{}{}", options.video.string(),
                  faster > 1 ? fmt::format(", {:.0f} times as fast as in reality", faster) : ""));
}

}  // namespace dipper::analysis::report
