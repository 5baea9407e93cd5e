#include "tests/system/campaign_folder.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "launch/campaign/record.h"

namespace fastball::system_test {
namespace fs = std::filesystem;

std::vector<std::string> CampaignFolder::command(int throws,
                                                 const std::vector<std::string>& more) const {
  std::vector<std::string> words = {"campaign",
                                    "--strategy",
                                    "robust",
                                    "--throws",
                                    std::to_string(throws),
                                    "--set-up-throws",
                                    "2",
                                    "--seed",
                                    "5",
                                    "--folder",
                                    path()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

nlohmann::json CampaignFolder::summary() const {
  std::ifstream file(path() + "/summary.json");
  if (!file)
    return nullptr;
  nlohmann::json object = nlohmann::json::parse(file);
  object.erase("throws_per_minute");
  return object;
}

int CampaignFolder::setUps() const {
  return fs::exists(path()) ? static_cast<int>(launch::readRecord(path()).size()) : 0;
}

int CampaignFolder::lines() const {
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(path())) {
    std::ifstream file(entry.path());
    for (std::string line; entry.path().extension() == ".jsonl" && std::getline(file, line);)
      count += line.empty() ? 0 : 1;
  }
  return count;
}

void CampaignFolder::awaitSetUps(const FastballRun& run, int count) const {
  while (run.running() && setUps() < count)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

std::vector<int> CampaignFolder::parts() const {
  std::vector<int> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "cmdline");
    const std::string words{std::istreambuf_iterator<char>(file), {}};
    const std::string sought = std::string("\0campaign-part\0", 15) + path() + '\0';
    if (words.find(sought) != std::string::npos)
      found.push_back(std::stoi(entry.path().filename()));
  }
  return found;
}

}  // namespace fastball::system_test
