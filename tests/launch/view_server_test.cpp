// The server of `fastball view` as browsers meet it: over sockets, and with messages from LCM.
#include "launch/view/view_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include "tests/launch/view_messages.h"

namespace fastball::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using nlohmann::json;
using testing::HasSubstr;

/// A folder with a page, and a server that serves it on a thread of its own.
class AServer : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ + "/assets");
    std::ofstream(folder_ + "/index.html") << "<!doctype html>";
    std::ofstream(folder_ + "/assets/a.js") << "1";
  }
  void TearDown() override {
    stop();
    std::filesystem::remove_all(folder_);
  }
  void start(const std::string& log = "", const std::string& host = "127.0.0.1") {
    ViewOptions options;
    options.log = log;
    options.config = config::experimentPath("");
    options.lcm_url = messaging::defaultLcmUrl();
    options.run.lcm_url = options.lcm_url;
    options.host = host;
    options.port = 0;
    options.page_folder = folder_;
    server_ = std::make_unique<ViewServer>(options);
    const std::string url = server_->url();
    port_ = url.substr(url.rfind(':') + 1);
    port_.pop_back();
    thread_ = std::thread([this] { server_->run([this] { return stopped_.load(); }); });
  }
  void stop() {
    stopped_ = true;
    if (thread_.joinable())
      thread_.join();
  }
  std::string host() const { return "127.0.0.1:" + port_; }

  http::response<http::string_body> get(const std::string& path,
                                        const std::string& origin = "",
                                        http::verb verb = http::verb::get) const {
    asio::io_context io;
    beast::tcp_stream stream(io);
    stream.connect(tcp::resolver(io).resolve("127.0.0.1", port_));
    http::request<http::string_body> request{verb, path, 11};
    request.set(http::field::host, host());
    if (!origin.empty())
      request.set(http::field::origin, origin);
    request.prepare_payload();
    http::write(stream, request);
    beast::flat_buffer buffer;
    http::response<http::string_body> response;
    http::read(stream, buffer, response);
    return response;
  }

  const std::string folder_ = testing::TempDir() + "view_page_" + std::to_string(getpid());
  std::unique_ptr<ViewServer> server_;
  std::string port_;

 private:
  std::thread thread_;
  std::atomic<bool> stopped_{false};
};

/// A page that looks on.
class Page {
 public:
  explicit Page(const std::string& port, const std::string& origin = "") {
    asio::connect(socket_.next_layer(), tcp::resolver(io_).resolve("127.0.0.1", port));
    const std::string host = "127.0.0.1:" + port;
    socket_.set_option(beast::websocket::stream_base::decorator(
        [origin =
             origin.empty() ? "http://" + host : origin](beast::websocket::request_type& request) {
          request.set(http::field::origin, origin);
        }));
    socket_.handshake(host, "/socket");
    greeting = json::parse(next());
  }
  /// The text of the next frame.
  json frame() {
    const std::string bytes = next();
    uint32_t length = 0;
    std::memcpy(&length, bytes.data(), sizeof(length));
    ++frames;
    json header = json::parse(bytes.substr(sizeof(length), length));
    samples += header.at("samples").get<int>() + header.value("skipped", 0);
    return header;
  }
  void order(const json& order) { socket_.write(asio::buffer(order.dump())); }

  json greeting;
  int frames = 0;
  int samples = 0;

 private:
  std::string next() {
    beast::flat_buffer buffer;
    socket_.read(buffer);
    return beast::buffers_to_string(buffer.data());
  }
  asio::io_context io_;
  beast::websocket::stream<tcp::socket> socket_{io_};
};

class AServerOfALog : public AServer {
 protected:
  void SetUp() override {
    AServer::SetUp();
    for (int i = 0; i <= kStates; ++i)
      file_.add(messaging::kArmState, armState(1, i));
    image_t image{};
    image.width = image.row_stride = 4;
    image.height = 3;
    image.pixelformat = image_t::GRAY;
    image.size = 12;
    image.data.assign(12, 100);
    file_.add(messaging::kCameraLeft, image);
    file_.close();
  }
  static constexpr int kStates = 25'000;
  WrittenLog file_;
};

TEST_F(AServerOfALog, ServesThePageAndNothingAroundIt) {
  start(file_.path);
  const auto page = get("/");
  EXPECT_EQ(page.result(), http::status::ok);
  EXPECT_EQ(page.body(), "<!doctype html>");
  EXPECT_THAT(std::string(page["Content-Security-Policy"]), HasSubstr("default-src 'none'"));
  EXPECT_EQ(get("/assets/a.js")[http::field::content_type], "text/javascript; charset=utf-8");
  EXPECT_EQ(get("/../view_page/index.html").result(), http::status::not_found);
  EXPECT_EQ(get("/assets/../../../etc/passwd").result(), http::status::not_found);
  EXPECT_EQ(get("/", "", http::verb::post).result(), http::status::method_not_allowed);
}

TEST_F(AServerOfALog, HandsOutImagesAsFilesThatABrowserKnows) {
  start(file_.path);
  const auto picture = get("/picture/CAMERA_LEFT/0");
  EXPECT_EQ(picture.result(), http::status::ok);
  EXPECT_EQ(picture[http::field::content_type], "image/png");
  EXPECT_THAT(picture.body(), HasSubstr("PNG"));
  for (const char* none : {"/picture/CAMERA_LEFT/1", "/picture/CAMERA_LEFT/-1", "/picture/OTHER/0",
                           "/picture/CAMERA_LEFT/", "/picture/CAMERA_LEFT/0x", "/picture/"})
    EXPECT_EQ(get(none).result(), http::status::not_found) << none;
}

TEST_F(AServerOfALog, RefusesOtherOrigins) {
  start(file_.path);
  const auto refused = get("/", "http://evil.example");
  EXPECT_EQ(refused.result(), http::status::forbidden);
  EXPECT_THAT(refused.body(), HasSubstr("http://evil.example"));
  EXPECT_THROW((Page{port_, "http://evil.example"}), boost::system::system_error);
  EXPECT_NO_THROW(Page{port_});
}

TEST_F(AServerOfALog, TellsTwoPagesTheWholeOfIt) {
  start(file_.path);
  Page one(port_), other(port_);
  for (Page* page : {&one, &other}) {
    EXPECT_FALSE(page->greeting.at("live"));
    EXPECT_FALSE(page->greeting.at("mayThrow"));
    json frame;
    do {
      frame = page->frame();
    } while (!frame.at("whole"));
    EXPECT_EQ(page->samples, kStates);
    EXPECT_GT(page->frames, 1);
  }
}

TEST_F(AServerOfALog, SaysOnThePageWhatTheLogHasNot) {
  start(file_.path);
  const json notices = Page(port_).frame().at("notices");
  EXPECT_THAT(notices.dump(), HasSubstr("The log has no HAND_STATE"));
}

TEST_F(AServerOfALog, NeedsAPageToServe) {
  std::filesystem::remove(folder_ + "/index.html");
  try {
    start(file_.path);
    FAIL() << "started without a page";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("apt-get install nodejs npm"));
  }
}

class AServerOfANetwork : public AServer {
 protected:
  void say(int64_t from, int64_t to) {
    for (int64_t i = from; i < to; ++i) {
      endpoint_.publish(messaging::kArmState, armState(1, i));
      if (i % 20 == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  messaging::LcmEndpoint endpoint_{messaging::defaultLcmUrl()};
};

TEST_F(AServerOfANetwork, SaysHowToBeginWhereNothingIsHeard) {
  start();
  Page page(port_);
  EXPECT_TRUE(page.greeting.at("mayThrow"));
  const json frame = page.frame();
  EXPECT_FALSE(frame.at("heard"));
  EXPECT_THAT(frame.at("advice").get<std::string>(), HasSubstr("fastball run"));
}

TEST_F(AServerOfANetwork, DoesNotWaitForAPageThatDoesNotRead) {
  start();
  Page slow(port_), quick(port_);
  constexpr int kStates = 40'000;
  std::thread speaker([this] { say(0, kStates + 1); });
  // What the slow page has not taken would fill every buffer on the way: 11 MB.
  while (quick.samples < kStates)
    quick.frame();
  speaker.join();
  while (slow.samples < kStates)
    slow.frame();
  EXPECT_EQ(slow.samples, quick.samples);
  EXPECT_LT(slow.frames, quick.frames);
}

TEST_F(AServerOfANetwork, RefusesAnOrderThatMakesNoSense) {
  start();
  Page page(port_);
  page.frame();
  for (const json& order :
       {json{{"order", "throw"}, {"throws", 1000}}, json{{"order", "throw"}, {"seed", -1}}}) {
    page.order(order);
    json frame;
    do {
      frame = page.frame();
    } while (!frame.contains("run") || !frame.at("run").at("failed").get<bool>());
    EXPECT_THAT(frame.at("run").at("words").get<std::string>(), HasSubstr("cannot be ordered"));
    EXPECT_FALSE(frame.at("run").at("goesOn"));
    page.order({{"order", "stop"}});
    do {
      frame = page.frame();
    } while (!frame.contains("run") || frame.at("run").at("failed").get<bool>());
  }
}

TEST_F(AServerOfANetwork, TakesNoOrdersWhereOthersCanReachIt) {
  start("", "0.0.0.0");
  EXPECT_FALSE(Page(port_).greeting.at("mayThrow"));
}

TEST_F(AServerOfANetwork, NamesThePortThatItCannotHave) {
  start();
  ViewOptions options;
  options.config = config::experimentPath("");
  options.lcm_url = messaging::defaultLcmUrl();
  options.page_folder = folder_;
  options.port = static_cast<unsigned short>(std::stoi(port_));
  EXPECT_THROW(ViewServer{options}, std::invalid_argument);
  options.host = "nowhere.example";
  EXPECT_THROW(ViewServer{options}, std::invalid_argument);
}

}  // namespace
}  // namespace fastball::view
