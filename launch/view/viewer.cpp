#include "launch/view/viewer.h"

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <utility>

namespace fastball::view {
namespace {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;

/// [bytes] An order is short.
constexpr std::size_t kLongestOrder = 4096;

}  // namespace

Viewer::Viewer(beast::tcp_stream stream, Order order)
    : socket_(std::move(stream)), order_(std::move(order)) {}

void Viewer::accept(const Request& request, std::string greeting) {
  // The WebSocket has a timeout of its own.
  beast::get_lowest_layer(socket_).expires_never();
  socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket_.read_message_max(kLongestOrder);
  request_ = request;
  auto self = shared_from_this();
  socket_.async_accept(request_, [self, greeting = std::move(greeting)](error_code error) mutable {
    if (error) {
      self->open_ = false;
      return;
    }
    self->writing_ = false;
    self->send(std::move(greeting), false);
    self->read();
  });
}

void Viewer::send(std::string message, bool binary) {
  writing_ = true;
  message_ = std::move(message);
  socket_.binary(binary);
  socket_.async_write(boost::asio::buffer(message_),
                      [self = shared_from_this()](error_code error, std::size_t /*bytes*/) {
                        self->writing_ = false;
                        self->open_ = self->open_ && !error;
                      });
}

void Viewer::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t /*bytes*/) {
    if (error) {
      self->open_ = false;
      return;
    }
    self->take();
    self->read();
  });
}

void Viewer::take() {
  const std::string words = beast::buffers_to_string(buffer_.data());
  buffer_.consume(buffer_.size());
  const auto order = nlohmann::json::parse(words, nullptr, false);
  if (order.is_object())
    order_(order);
}

}  // namespace fastball::view
