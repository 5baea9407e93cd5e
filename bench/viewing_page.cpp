#include "bench/viewing_page.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>

namespace fastball::bench {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;

/// One connection, over which images are fetched.
class PictureSource {
 public:
  PictureSource(asio::io_context& io, const tcp::resolver::results_type& server) : stream_(io) {
    stream_.connect(server);
  }
  bool fetch(const std::string& channel, int64_t number) {
    http::request<http::empty_body> request{
        http::verb::get, "/picture/" + channel + "/" + std::to_string(number), 11};
    request.set(http::field::host, "127.0.0.1");
    http::write(stream_, request);
    http::response<http::string_body> response;
    http::read(stream_, buffer_, response);
    return response.result() == http::status::ok;
  }

 private:
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
};

nlohmann::json headerOf(const std::string& frame) {
  uint32_t length = 0;
  std::memcpy(&length, frame.data(), sizeof(length));
  return nlohmann::json::parse(frame.substr(sizeof(length), length));
}

}  // namespace

ViewingPage::ViewingPage(const std::string& port) : thread_([this, port] { look(port); }) {}

ViewingPage::~ViewingPage() {
  ended_ = true;
  thread_.join();
}

void ViewingPage::look(const std::string& port) {
  asio::io_context io;
  const auto server = tcp::resolver(io).resolve("127.0.0.1", port);
  beast::websocket::stream<tcp::socket> socket(io);
  asio::connect(socket.next_layer(), server);
  socket.handshake("127.0.0.1", "/socket");
  PictureSource source(io, server);
  beast::flat_buffer buffer;
  socket.read(buffer);  // the greeting
  buffer.clear();
  while (!ended_) {
    if (socket.next_layer().available() == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      continue;
    }
    socket.read(buffer);
    const auto header = headerOf(beast::buffers_to_string(buffer.data()));
    buffer.clear();
    ++frames_;
    if (!header.contains("pictures"))
      continue;
    for (const auto& [channel, told] : header.at("pictures").items()) {
      const int64_t newest =
          told.at("from").get<int64_t>() + static_cast<int64_t>(told.at("t").size()) - 1;
      pictures_ += source.fetch(channel, newest) ? 1 : 0;
    }
  }
}

}  // namespace fastball::bench
