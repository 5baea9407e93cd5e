#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <optional>
#include <string>

#include "launch/view/page_files.h"
#include "launch/view/request_check.h"
#include "launch/view/viewer.h"

namespace fastball::view {

/// What is served beside the page.
struct Served {
  /// The picture `index` of a camera as a file that a browser can show; nothing if it is not kept.
  std::function<std::optional<PageFiles::File>(const std::string& channel, int64_t index)> picture;
  /// A page wants to become a viewer.
  std::function<void(boost::beast::tcp_stream, const Viewer::Request&)> join;
};

/// A small HTTP server: the files of the page, /picture/CHANNEL/NUMBER, and /socket, where a page becomes a viewer. Requests from
/// other origins are refused (request_check.h). Everything happens inside `io`, on the thread that runs it.
class WebServer {
 public:
  /// Listens. Port 0: any that is free.
  /// @throw std::invalid_argument if `host` is no address, or it and the port cannot be had.
  WebServer(boost::asio::io_context& io,
            const std::string& host,
            unsigned short port,
            PageFiles files,
            Served served);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  const Door& door() const { return door_; }

 private:
  class Session;
  void accept();

  boost::asio::ip::tcp::acceptor acceptor_;
  Door door_;
  PageFiles files_;
  Served served_;
};

}  // namespace fastball::view
