#include "launch/spy/terminal_view.h"

#define NCURSES_NOMACROS
#include <curses.h>
#include <fmt/format.h>
#include <langinfo.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <string>

#include "launch/spy/field_summary.h"
#include "launch/spy/plot.h"
#include "launch/spy/traffic_text.h"

namespace fastball::launch {
namespace {

constexpr int kEscape = 27;
constexpr int kEscapeDelayMs = 25;
constexpr int kPlotRows = 6;
/// A window lower than this shows no plot below the members.
constexpr int kPlotFromRows = 16;
constexpr std::size_t kHistory = 512;
constexpr std::size_t kNameCells = 28;
constexpr std::size_t kWordCells = 26;

/// Which line of a list is chosen, and which is the first to be seen.
struct Choice {
  int chosen = 0;
  int top = 0;

  void move(int steps, int count) {
    chosen = std::clamp(chosen + steps, 0, std::max(count - 1, 0));
  }
  void scroll(int rows, int count) {
    move(0, count);
    top = std::clamp(top, std::max(chosen - rows + 1, 0), chosen);
    top = std::clamp(top, 0, std::max(count - rows, 0));
  }
};

/// What a key means in both lists.
int stepsOf(int key, int rows) {
  switch (key) {
    case KEY_UP:
    case 'k':
      return -1;
    case KEY_DOWN:
    case 'j':
      return 1;
    case KEY_PPAGE:
      return -rows;
    case KEY_NPAGE:
      return rows;
    default:
      return 0;
  }
}

/// ASCII text at a place of the screen; what does not fit is left out.
void put(int row, int column, const std::string& text) {
  if (row >= 0 && row < LINES && column < COLS)
    mvaddnstr(row, column, text.c_str(), COLS - column);
}

void putLine(int row, std::string text, attr_t attributes) {
  text.resize(static_cast<std::size_t>(COLS), ' ');
  attron(static_cast<int>(attributes));
  put(row, 0, text);
  attroff(static_cast<int>(attributes));
}

std::string fitted(std::string text, std::size_t cells) {
  if (text.size() > cells)
    text = text.substr(0, cells - 1) + '~';
  return text;
}

}  // namespace

struct TerminalView::State {
  std::string title;
  double interval_s = 0;
  PlotStyle style;
  SCREEN* screen = nullptr;
  Choice channels;
  std::string channel;  ///< the chosen one, which new names must not move
  bool is_open = false;
  Choice members;
  FieldHistory history{kHistory};

  int listRows() const {
    const int plot = is_open && LINES >= kPlotFromRows ? kPlotRows + 1 : 0;
    return std::max(LINES - 3 - plot, 1);
  }

  /// Keeps the choice on its channel when channels have come.
  void follow(const std::vector<ChannelReport>& reports) {
    const auto found = std::find_if(reports.begin(), reports.end(), [this](const auto& report) {
      return report.channel == channel;
    });
    if (found != reports.end())
      channels.chosen = static_cast<int>(found - reports.begin());
    channels.scroll(listRows(), static_cast<int>(reports.size()));
    if (found == reports.end() && !reports.empty())
      channel = reports[static_cast<std::size_t>(channels.chosen)].channel;
  }

  void drawChannels(const std::vector<ChannelReport>& reports, int64_t unlisted) const {
    const TrafficTable table = trafficTable(reports, static_cast<std::size_t>(COLS));
    putLine(1, table.heading, A_BOLD);
    const int count = static_cast<int>(table.lines.size());
    for (int row = 0; row < listRows() && channels.top + row < count; ++row) {
      const int i = channels.top + row;
      putLine(2 + row, table.lines[static_cast<std::size_t>(i)],
              i == channels.chosen ? A_REVERSE : A_NORMAL);
    }
    if (reports.empty())
      put(3, 2, "nothing heard yet");
    std::string keys = "up, down, j, k: choose   Enter: members   q: quit";
    if (unlisted > 0)
      keys += fmt::format("   {} messages on further channels", unlisted);
    putLine(LINES - 1, keys, A_DIM);
  }

  void drawMembers(const ChannelReport& report, const std::vector<FieldLine>& lines) {
    const TrafficTable table = trafficTable({report}, static_cast<std::size_t>(COLS));
    putLine(1, table.lines.front(), A_BOLD);
    const int count = static_cast<int>(lines.size());
    members.scroll(listRows(), count);
    if (lines.empty())
      put(3, 2, "no message of a known type; --types LIBRARY.so adds types");
    for (int row = 0; row < listRows() && members.top + row < count; ++row) {
      const int i = members.top + row;
      drawMember(2 + row, lines[static_cast<std::size_t>(i)], i == members.chosen);
    }
    if (!lines.empty() && LINES >= kPlotFromRows)
      drawPlot(lines[static_cast<std::size_t>(members.chosen)]);
    putLine(LINES - 1, "up, down, j, k: choose what is plotted   q, Esc: back", A_DIM);
  }

  void drawMember(int row, const FieldLine& line, bool is_chosen) const {
    putLine(row, fmt::format("{:{}} {}", fitted(line.name, kNameCells), kNameCells, line.words),
            is_chosen ? A_REVERSE : A_NORMAL);
    const auto column = static_cast<int>(kNameCells + 2 + std::max(kWordCells, line.words.size()));
    if (line.number && column + 10 < COLS)
      putPlot(row, column, line.name, 1);
  }

  void drawPlot(const FieldLine& line) const {
    const int row = LINES - 2 - kPlotRows;
    const std::deque<double>& samples = history.of(line.name);
    const auto drawn = std::min(samples.size(), static_cast<std::size_t>(std::max(COLS - 1, 0)));
    double low = 0;
    double high = 0;
    bool any = false;
    for (auto sample = samples.end() - static_cast<std::ptrdiff_t>(drawn); sample != samples.end();
         ++sample) {
      if (*sample != *sample)
        continue;
      low = any ? std::min(low, *sample) : *sample;
      high = any ? std::max(high, *sample) : *sample;
      any = true;
    }
    putLine(row,
            any ? fmt::format("{}: {:.6g} to {:.6g} in the last {:.1f} s", line.name, low, high,
                              interval_s * static_cast<double>(drawn))
                : fmt::format("{}: no number", line.name),
            A_BOLD);
    if (any)
      putPlot(row + 1, 0, line.name, kPlotRows);
  }

  void putPlot(int row, int column, const std::string& name, int rows) const {
    const auto width = static_cast<std::size_t>(std::max(COLS - column - 1, 0));
    for (const std::string& text :
         plot(history.of(name), width, static_cast<std::size_t>(rows), style)) {
      if (row >= 0 && row < LINES)
        mvaddstr(row, column, text.c_str());
      ++row;
    }
  }

  /// `sample`: the plots go on by one.
  void draw(const Traffic& traffic, int64_t now, bool sample) {
    const auto reports = traffic.report(now);
    follow(reports);
    erase();
    putLine(0, title, A_NORMAL);
    if (is_open && !reports.empty()) {
      const auto lines = fieldLines(traffic.newestFields(channel));
      if (sample)
        history.add(lines);
      drawMembers(reports[static_cast<std::size_t>(channels.chosen)], lines);
    } else {
      drawChannels(reports, traffic.unlisted());
    }
    refresh();
  }

  /// @return false: quit.
  bool press(int key, const std::vector<ChannelReport>& reports) {
    const bool back = key == 'q' || key == kEscape;
    if (is_open) {
      is_open = !back && key != KEY_LEFT;
      members.move(stepsOf(key, listRows()), 1 << 20);  // drawn within the members there are
      return true;
    }
    if (key == '\n' || key == '\r' || key == KEY_ENTER || key == KEY_RIGHT) {
      is_open = !reports.empty();
      members = {};
      history.clear();
    }
    channels.move(stepsOf(key, listRows()), static_cast<int>(reports.size()));
    if (!reports.empty())
      channel = reports[static_cast<std::size_t>(channels.chosen)].channel;
    return !back;
  }
};

std::unique_ptr<TerminalView> TerminalView::open(const std::string& title, double interval_s) {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0)
    return nullptr;
  auto state = std::make_unique<State>();
  state->title = printable(title);
  state->interval_s = interval_s;
  std::setlocale(LC_CTYPE, "");
  state->style.blocks = std::string(nl_langinfo(CODESET)) == "UTF-8";
  set_escdelay(kEscapeDelayMs);
  state->screen = newterm(nullptr, stdout, stdin);
  if (state->screen == nullptr)
    return nullptr;
  cbreak();
  noecho();
  nonl();
  keypad(stdscr, true);
  nodelay(stdscr, true);
  curs_set(0);
  return std::unique_ptr<TerminalView>(new TerminalView(std::move(state)));
}

TerminalView::TerminalView(std::unique_ptr<State> state) : state_(std::move(state)) {}

TerminalView::~TerminalView() {
  endwin();
  delscreen(state_->screen);
}

void TerminalView::show(const Traffic& traffic, int64_t now) {
  state_->draw(traffic, now, true);
}

bool TerminalView::readKeys(const Traffic& traffic, int64_t now) {
  const auto reports = traffic.report(now);
  bool any = false;
  for (int key = getch(); key != ERR; key = getch()) {
    any = true;
    if (!state_->press(key, reports))
      return false;
  }
  if (any)
    state_->draw(traffic, now, false);
  return true;
}

}  // namespace fastball::launch
