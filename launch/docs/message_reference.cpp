#include "launch/docs/message_reference.h"

#include <fmt/format.h>

#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>
#include <vector>

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

/// A message as its file describes it.
struct Message {
  std::string name;      ///< "arm_state_t"
  std::string channels;  ///< "ARM_STATE"
  std::string when;      ///< "1 kHz"
  std::string sender, receivers;
  std::string heading;  ///< the comment before the struct
  std::string fields;   ///< the struct's lines
};

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t"), to = text.find_last_not_of(" \t");
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

/// The first line's channel names and what follows them: "ARM_STATE, 1 kHz".
void takeChannel(const std::string& text, Message& message) {
  static const std::regex names("^((?:[A-Z_]+, )*[A-Z_]+)(?:, (.*))?$");
  std::smatch match;
  if (!std::regex_match(text, match, names))
    return;
  message.channels = match[1];
  message.when = match[2];
}

Message readMessage(const fs::path& path) {
  Message message;
  message.name = path.stem();
  std::ifstream file(path);
  std::string* part = nullptr;  // that goes on in an indented line
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("//", 0) == 0) {
      static const std::regex key("^// (Channels?|Sender|Receivers)\\s+(.*)$");
      std::smatch match;
      message.heading += (line.size() > 3 ? line.substr(3) : "") + "\n";
      if (std::regex_match(line, match, key)) {
        std::string text = match[2];
        if (match[1] == "Sender")
          *(part = &message.sender) = text;
        else if (match[1] == "Receivers")
          *(part = &message.receivers) = text;
        else
          takeChannel(text, message), part = &message.when;
      } else if (part != nullptr && line.rfind("//    ", 0) == 0) {
        *part += " " + trimmed(line.substr(2));
      } else {
        part = nullptr;
      }
    } else if (line.rfind("    ", 0) == 0) {
      message.fields += line.substr(4) + "\n";
    } else if (line.empty() && !message.fields.empty()) {
      message.fields += "\n";
    }
  }
  if (message.channels.empty() || message.fields.empty())
    throw std::runtime_error(fmt::format(
        "{}: does not begin with a comment on its channel and hold a struct", path.string()));
  return message;
}

std::vector<Message> readMessages(const fs::path& folder) {
  std::set<fs::path> paths;
  if (fs::is_directory(folder)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".lcm")
        paths.insert(entry.path());
    }
  }
  if (paths.empty())
    throw std::runtime_error(fmt::format("{}: holds no .lcm files", folder.string()));
  std::vector<Message> messages;
  for (const fs::path& path : paths)
    messages.push_back(readMessage(path));
  return messages;
}

}  // namespace

std::string messageReference(const fs::path& folder) {
  const std::vector<Message> messages = readMessages(folder);
  std::string page =
      "# Messages\n\nMade from `lcmtypes/` by `fastball docs messages`; the files are what counts. "
      "SI units, radians, microseconds; the world frame W has its origin at the shoulder's centre, "
      "x forward, y left, z up. Every sender counts its messages on a channel in `seq`.\n\n"
      "| channel | message | when | sender | receivers |\n| --- | --- | --- | --- | --- |\n";
  for (const Message& message : messages)
    page += fmt::format("| {} | [`{}`](#{}) | {} | {} | {} |\n", message.channels, message.name,
                        message.name, message.when, message.sender, message.receivers);
  for (const Message& message : messages)
    page +=
        fmt::format("\n## {}\n\n```\n{}\n{}```\n", message.name, message.heading, message.fields);
  return page;
}

}  // namespace fastball::launch
