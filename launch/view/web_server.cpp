#include "launch/view/web_server.h"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <charconv>
#include <chrono>
#include <memory>
#include <stdexcept>

namespace fastball::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;

constexpr auto kPatience = std::chrono::seconds(30);
constexpr std::size_t kLongestBody = 1024;
const std::string kPicturePath = "/picture/";

/// Only what this server serves itself.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

using Response = http::response<http::string_body>;

Response answer(const Viewer::Request& request,
                http::status status,
                const std::string& type,
                std::string body) {
  Response response{status, request.version()};
  response.set(http::field::content_type, type);
  response.set("Content-Security-Policy", kContentPolicy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Referrer-Policy", "no-referrer");
  response.set(http::field::cache_control, "no-store");
  response.keep_alive(request.keep_alive());
  response.content_length(body.size());
  if (request.method() != http::verb::head)
    response.body() = std::move(body);
  return response;
}

Response sentence(const Viewer::Request& request, http::status status, const std::string& words) {
  return answer(request, status, "text/plain; charset=utf-8", words + "\n");
}

/// "/picture/CAMERA_LEFT/17" as channel and number.
std::optional<std::pair<std::string, int64_t>> pictureOf(const std::string& path) {
  const auto slash = path.rfind('/');
  if (path.rfind(kPicturePath, 0) != 0 || slash < kPicturePath.size())
    return std::nullopt;
  int64_t number = 0;
  const char* end = path.data() + path.size();
  const auto read = std::from_chars(path.data() + slash + 1, end, number);
  if (read.ec != std::errc{} || read.ptr != end)
    return std::nullopt;
  return std::make_pair(path.substr(kPicturePath.size(), slash - kPicturePath.size()), number);
}

}  // namespace

/// One connection: request after request, until it becomes a viewer or ends.
class WebServer::Session : public std::enable_shared_from_this<WebServer::Session> {
 public:
  Session(tcp::socket socket, const WebServer& server)
      : stream_(std::move(socket)), server_(server) {}

  void read() {
    parser_.emplace();
    parser_->body_limit(kLongestBody);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t /*bytes*/) {
                       if (error)
                         self->close();
                       else
                         self->handle();
                     });
  }

 private:
  void handle() {
    const Viewer::Request& request = parser_->get();
    const std::string path(request.target());
    const std::string why = refusal(request, server_.door_);
    if (!why.empty())
      return write(sentence(request, http::status::forbidden, why));
    if (path == "/socket" && beast::websocket::is_upgrade(request))
      return server_.served_.join(std::move(stream_), request);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return write(sentence(request, http::status::method_not_allowed, "only GET is served"));
    std::optional<PageFiles::File> file;
    if (const auto picture = pictureOf(path))
      file = server_.served_.picture(picture->first, picture->second);
    else if (const PageFiles::File* found = server_.files_.find(path))
      file = *found;
    if (!file)
      return write(sentence(request, http::status::not_found, "there is no " + path));
    write(answer(request, http::status::ok, file->type, std::move(file->bytes)));
  }

  void write(Response response) {
    auto kept = std::make_shared<Response>(std::move(response));
    http::async_write(stream_, *kept,
                      [self = shared_from_this(), kept](error_code error, std::size_t /*bytes*/) {
                        if (error || kept->need_eof())
                          self->close();
                        else
                          self->read();
                      });
  }

  void close() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  const WebServer& server_;
};

WebServer::WebServer(asio::io_context& io,
                     const std::string& host,
                     unsigned short port,
                     PageFiles files,
                     Served served)
    : acceptor_(io), files_(std::move(files)), served_(std::move(served)) {
  error_code error;
  const auto address = asio::ip::make_address(host == "localhost" ? "127.0.0.1" : host, error);
  if (error)
    throw std::invalid_argument(
        fmt::format("--host takes an address such as 127.0.0.1 or 0.0.0.0, not '{}'", host));
  const tcp::endpoint endpoint(address, port);
  try {
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(asio::socket_base::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen();
  } catch (const boost::system::system_error& e) {
    throw std::invalid_argument(fmt::format(
        "cannot listen on {} port {}: {}; --port takes another one (0: any that is free)", host,
        port, e.code().message()));
  }
  door_ = {address.to_string(), acceptor_.local_endpoint().port()};
  accept();
}

void WebServer::accept() {
  acceptor_.async_accept([this](error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted)
      return;
    if (!error) {
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<Session>(std::move(socket), *this)->read();
    }
    accept();
  });
}

}  // namespace fastball::view
