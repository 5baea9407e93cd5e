#include "bench/logger_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>

#include "bench/logged_traffic.h"
#include "bench/timing.h"

namespace fastball::bench {
namespace {

constexpr double kSeconds = 10;
constexpr int kBusyLoops = 4;
/// An image of the simulator's cameras as JPEG, and a state, take so many bytes.
constexpr std::size_t kImageBytes = 24000;
constexpr std::size_t kStateBytes = 136;

constexpr std::size_t kBigBytes = 300'000;
constexpr double kBigSeconds = 2;
constexpr double kMega = 1e6;

/// Both loggers hear the same messages from sockets with the same buffer.
std::string url() {
  return messaging::withReceiveBuffer(privateLcmUrl());
}

std::string kernelLimit() {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  int64_t bytes = 0;
  file >> bytes;
  return fmt::format("receive buffer of the kernel {} kB", bytes / 1000);
}

struct Losses {
  int64_t sent = 0;
  int64_t ours = 0;
  std::optional<int64_t> stock;
};

Losses lossesUnderLoad() {
  const std::vector<Stream> streams{
      {"IMAGE_LEFT", kImageBytes, 240}, {"IMAGE_RIGHT", kImageBytes, 240},
      {"STATE_1", kStateBytes, 1000},   {"STATE_2", kStateBytes, 1000},
      {"STATE_3", kStateBytes, 1000},   {"BURST", kStateBytes, 1, 1000}};
  const std::string network = url();
  std::vector<LoggerCommand> loggers{ourLogger(network)};
  if (!stockLogger(network).program.empty())
    loggers.push_back(stockLogger(network));
  Losses losses;
  const auto lost = lostBy(loggers, network, [&](messaging::LcmEndpoint& endpoint) {
    const BusyLoops busy(kBusyLoops);
    double took = 0;
    auto sent = sayStreams(endpoint, streams, kSeconds, took);
    for (const auto& [channel, count] : sent)
      losses.sent += count;
    return sent;
  });
  losses.ours = lost.at(0);
  if (lost.size() > 1)
    losses.stock = lost.at(1);
  return losses;
}

/// [MB/s] the highest of some rates of big messages of which the logger lost none.
double lossless(const LoggerCommand& logger, const std::string& network) {
  double best = 0;
  for (const double rate : {50.0, 100.0, 150.0, 200.0, 250.0, 300.0}) {
    double took = 0;
    int64_t sent = 0;
    const auto lost = lostBy({logger}, network, [&](messaging::LcmEndpoint& endpoint) {
      const std::vector<Stream> big{{"BIG", kBigBytes, rate * kMega / kBigBytes}};
      auto counts = sayStreams(endpoint, big, kBigSeconds, took);
      sent = counts["BIG"];
      return counts;
    });
    if (lost.at(0) > 0)
      break;
    best = std::max(best, static_cast<double>(sent) * kBigBytes / kMega / took);
  }
  return best;
}

Row throughput() {
  const std::string network = url();
  Row row;
  row.id = "logger.mb_per_s";
  row.value = lossless(ourLogger(network), network);
  row.unit = "MB/s";
  row.note = fmt::format("300 kB messages for {} s, none lost; {}", kBigSeconds, kernelLimit());
  const LoggerCommand stock = stockLogger(network);
  if (!stock.program.empty()) {
    row.peer = "stock lcm-logger, same buffer";
    row.peer_value = lossless(stock, network);
  }
  return row;
}

}  // namespace

std::vector<Benchmark> loggerBenchmarks() {
  // Measured when the first row asks for it.
  auto measured = std::make_shared<std::optional<Losses>>();
  const auto losses = [measured]() -> const Losses& {
    if (!*measured)
      *measured = lossesUnderLoad();
    return **measured;
  };
  std::vector<Benchmark> rows{
      {"logger.lost", [losses] {
         Row row;
         row.id = "logger.lost";
         row.value = static_cast<double>(losses().ours);
         row.unit = "messages";
         row.peer = "stock lcm-logger, same run";
         if (losses().stock)
           row.peer_value = static_cast<double>(*losses().stock);
         row.note = fmt::format(
             "of {}: 2 x 240 Hz images of {} kB, 3 x 1 kHz, bursts of 1000, for {} s beside {} "
             "busy "
             "loops; {}",
             losses().sent, kImageBytes / 1000, kSeconds, kBusyLoops, kernelLimit());
         return row;
       }}};
  if (!stockLogger("").program.empty()) {
    rows.push_back({"logger.stock_lost", [losses] {
                      return Row{"logger.stock_lost",
                                 static_cast<double>(losses().stock.value_or(0)),
                                 "messages",
                                 "our logger, same run",
                                 static_cast<double>(losses().ours),
                                 "lcm-logger with the same receive buffer"};
                    }});
  }
  rows.push_back({"logger.mb_per_s", throughput});
  return rows;
}

}  // namespace fastball::bench
