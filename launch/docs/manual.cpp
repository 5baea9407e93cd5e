#include "launch/docs/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

namespace fastball::launch {
namespace {

std::vector<const CLI::App*> shownCommands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> shownOptions(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

/// troff takes '\', '-' and a leading '.' or ''' for its own.
std::string troff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  if (!escaped.empty() && (escaped[0] == '.' || escaped[0] == '\''))
    escaped.insert(0, "\\&");
  return escaped;
}

/// "INT in [1 - 10]" of CLI11's "INT:INT in [1 - 10]".
std::string valueOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  return colon == std::string::npos ? type : type.substr(colon + 1);
}

std::string manualOption(const CLI::Option& option) {
  std::string entry = ".TP\n\\fB" + troff(option.get_name(false, true)) + "\\fR";
  if (option.get_items_expected_max() > 0 && !valueOf(option).empty())
    entry += " \\fI" + troff(valueOf(option)) + "\\fR";
  entry += "\n" + troff(option.get_description());
  if (!option.get_default_str().empty())
    entry += troff(" (default: " + option.get_default_str() + ")");
  return entry + "\n";
}

void addManualOf(const CLI::App& command, const std::string& name, std::string& page) {
  page += fmt::format(".SS {}\n{}\n", troff(name), troff(command.get_description()));
  for (const CLI::Option* option : shownOptions(command)) {
    if (option != command.get_help_ptr())
      page += manualOption(*option);
  }
  for (const CLI::App* nested : shownCommands(command))
    addManualOf(*nested, name + " " + nested->get_name(), page);
}

/// The words that an option allows, of CLI11's "TEXT:{paper,robust}"; empty where any will do.
std::string choicesOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t from = type.find('{'), to = type.find('}');
  if (from == std::string::npos || to == std::string::npos || to < from)
    return "";
  std::string words = type.substr(from + 1, to - from - 1);
  for (char& c : words)
    c = c == ',' ? ' ' : c;
  return words;
}

std::string longFlags(const CLI::App& command) {
  std::string flags;
  for (const CLI::Option* option : shownOptions(command)) {
    for (const std::string& flag : option->get_lnames())
      flags += (flags.empty() ? "--" : " --") + flag;
  }
  return flags;
}

std::string namesOf(const std::vector<const CLI::App*>& commands) {
  std::string names;
  for (const CLI::App* command : commands)
    names += (names.empty() ? "" : " ") + command->get_name();
  return names;
}

/// The case of one command in the completion's `case`, and those of the commands nested in it.
void addCompletionOf(const CLI::App& command, const std::string& path, std::string& cases) {
  for (const CLI::Option* option : shownOptions(command)) {
    if (const std::string words = choicesOf(*option); !words.empty()) {
      for (const std::string& flag : option->get_lnames())
        cases += fmt::format("    '{} --{}') words='{}' files='' ;;\n", path, flag, words);
    }
  }
  const std::vector<const CLI::App*> nested = shownCommands(command);
  cases += fmt::format("    '{} '*) words='{}'{} ;;\n", path,
                       namesOf(nested) + (nested.empty() ? "" : " ") + longFlags(command),
                       nested.empty() ? "" : " files=''");
}

}  // namespace

std::string manualPage(const CLI::App& app, const std::string& version) {
  std::string page = fmt::format(
      ".TH FASTBALL 1 \"\" \"fastball {}\" \"User Commands\"\n.SH NAME\nfastball \\- {}\n"
      ".SH SYNOPSIS\n.B fastball\n.I COMMAND\n.RI [ OPTIONS ]\n.SH COMMANDS\n",
      troff(version), troff(app.get_description()));
  for (const CLI::App* command : shownCommands(app))
    addManualOf(*command, "fastball " + command->get_name(), page);
  page +=
      ".SH EXIT STATUS\n0 done, 1 the experiment failed, 2 wrong usage or a bad input file; the "
      "message says what and where.\n"
      ".SH ENVIRONMENT\n.TP\n.B FASTBALL_CONFIG\nThe experiment file where no \\fB\\-\\-config\\fR "
      "names one.\n";
  return page;
}

std::string bashCompletion(const CLI::App& app) {
  std::string cases;
  for (const CLI::App* command : shownCommands(app))
    addCompletionOf(*command, command->get_name(), cases);
  return fmt::format(
      R"(# bash completion for fastball
_fastball() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words='' files=1
  if [ "$COMP_CWORD" = 1 ]; then
    words='{} --help --version'
  else
    case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}" in
{}    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  [ -z "$files" ] || [ "$COMP_CWORD" = 1 ] || [ "${{word#-}}" != "$word" ] || COMPREPLY+=($(compgen -f -- "$word"))
}}
complete -o filenames -F _fastball fastball
)",
      namesOf(shownCommands(app)), cases);
}

}  // namespace fastball::launch
