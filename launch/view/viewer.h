#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "launch/view/frame.h"

namespace fastball::view {

/// One page that looks on: a WebSocket. One message is on its way to it at most; while it has not been taken there is nothing
/// else for this viewer, and nobody waits for it.
class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  using Order = std::function<void(const nlohmann::json&)>;
  /// `order`: called with each JSON object that the page sends.
  Viewer(boost::beast::tcp_stream stream, Order order);

  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  /// Answers the request to become a WebSocket, and sends `greeting` first.
  void accept(const Request& request, std::string greeting);

  bool open() const { return open_; }
  /// True if the last message has been taken.
  bool ready() const { return open_ && !writing_; }
  /// Sends a message. Only when ready().
  void send(std::string message, bool binary);

  Cursor cursor;
  std::string told;  ///< what else it has been told, as sent

 private:
  void read();
  void take();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::beast::flat_buffer buffer_;
  Request request_;
  Order order_;
  std::string message_;
  bool open_ = true;
  bool writing_ = true;  // until the greeting has been taken
};

}  // namespace fastball::view
