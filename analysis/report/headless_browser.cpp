#include "analysis/report/headless_browser.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "common/json_text.hpp"

namespace dipper::analysis::report {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kStart{60};

std::vector<std::string> command(const fs::path& program, const fs::path& profile) {
  std::vector<std::string> words = {program.string(),
                                    "--headless=new",
                                    "--remote-debugging-pipe",
                                    "--disable-dev-shm-usage",
                                    "--use-gl=angle",
                                    "--use-angle=swiftshader",
                                    "--enable-unsafe-swiftshader",
                                    "--disable-background-networking",
                                    "--disable-component-update",
                                    "--disable-sync",
                                    "--no-first-run",
                                    "--window-size=1280,900",
                                    "--user-data-dir=" + profile.string()};
  if (geteuid() == 0) words.emplace_back("--no-sandbox");  // Chromium refuses root otherwise
  words.emplace_back("about:blank");
  return words;
}

/// The child's end: it reads requests on 3 and answers on 4.
[[noreturn]] void become(std::vector<std::string> words, int in, int out) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Moved above 4 first: one of the two may be at the other's number.
  const int asked = fcntl(in, F_DUPFD, 10), answers = fcntl(out, F_DUPFD, 10);
  dup2(asked, 3);
  dup2(answers, 4);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int fd : {0, 1, 2}) dup2(nothing, fd);
  for (int fd = 5; fd < 256; ++fd) close(fd);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(127);
}

}  // namespace

std::optional<fs::path> program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / name;
    if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

std::optional<fs::path> find_browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"})
    if (auto program = program_on_path(name)) return program;
  return std::nullopt;
}

HeadlessBrowser::HeadlessBrowser(const fs::path& program, const fs::path& page) {
  std::array<int, 2> asked{}, answers{};
  if (pipe2(asked.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe to the browser");
  std::vector<std::string> words = command(program, profile_.path());
  pid_ = fork();
  if (pid_ == 0) become(std::move(words), asked[0], answers[1]);
  close(asked[0]);
  close(answers[1]);
  to_ = asked[1];
  from_ = answers[0];
  try {
    const json made = ask("Target.createTarget", {{"url", "about:blank"}}, kStart);
    const json attached = ask("Target.attachToTarget",
                              {{"targetId", made.at("targetId")}, {"flatten", true}}, kStart);
    session_ = attached.at("sessionId");
    // Answered when the page has replaced the blank one: later evaluations then persist.
    ask("Page.navigate", {{"url", "file://" + fs::absolute(page).string()}}, kStart);
  } catch (...) {
    end();
    throw;
  }
}

HeadlessBrowser::~HeadlessBrowser() { end(); }

void HeadlessBrowser::end() {
  close(to_);
  close(from_);
  if (pid_ > 0) {
    kill(-pid_, SIGTERM);
    int status = 0;
    for (int k = 0; k < 50 && waitpid(pid_, &status, WNOHANG) == 0; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(-pid_, SIGKILL);
    waitpid(pid_, &status, WNOHANG);
  }
}

std::string HeadlessBrowser::next_message(steady_clock::time_point until) {
  while (true) {
    if (const auto end = unread_.find('\0'); end != std::string::npos) {
      std::string message = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      return message;
    }
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - steady_clock::now());
    pollfd ready{from_, POLLIN, 0};
    if (left.count() <= 0 || poll(&ready, 1, static_cast<int>(left.count())) == 0)
      throw std::runtime_error("the browser does not answer");
    std::array<char, 1 << 16> bytes{};
    const ssize_t n = read(from_, bytes.data(), bytes.size());
    if (n <= 0) throw std::runtime_error("the browser has ended");
    unread_.append(bytes.data(), static_cast<std::size_t>(n));
  }
}

json HeadlessBrowser::ask(const std::string& method, json parameters,
                          std::chrono::seconds patience) {
  const auto until = steady_clock::now() + patience;
  json question = {{"id", ++last_id_}, {"method", method}, {"params", std::move(parameters)}};
  if (!session_.empty()) question["sessionId"] = session_;
  const std::string text = question.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(to_, text.data() + sent, text.size() - sent);
    if (n <= 0) throw std::runtime_error("the browser has ended");
    sent += static_cast<std::size_t>(n);
  }
  while (true) {
    const json answer = parse_json_or_discard(next_message(until));
    if (!answer.is_object() || answer.value("id", 0) != last_id_) continue;  // an event
    if (answer.contains("error"))
      throw std::runtime_error(
          fmt::format("the browser refuses {}: {}", method, answer["error"].dump()));
    return answer.value("result", json::object());
  }
}

json HeadlessBrowser::evaluate(const std::string& expression, std::chrono::seconds patience) {
  const json said =
      ask("Runtime.evaluate",
          {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}}, patience);
  if (said.contains("exceptionDetails"))
    throw std::runtime_error("the page cannot be drawn: " + said["exceptionDetails"].dump());
  return said.at("result").value("value", json());
}

}  // namespace dipper::analysis::report
