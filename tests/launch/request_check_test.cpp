// Who may talk to the server of `fastball view`.
#include "launch/view/request_check.h"

#include <gtest/gtest.h>

namespace fastball::view {
namespace {

boost::beast::http::fields request(const std::string& host,
                                   const std::string& origin = "",
                                   const std::string& site = "",
                                   const std::string& mode = "") {
  boost::beast::http::fields fields;
  fields.set("Host", host);
  if (!origin.empty())
    fields.set("Origin", origin);
  if (!site.empty())
    fields.set("Sec-Fetch-Site", site);
  if (!mode.empty())
    fields.set("Sec-Fetch-Mode", mode);
  return fields;
}

const Door kLocal{"127.0.0.1", 8080};
const Door kWide{"0.0.0.0", 8080};

TEST(ARequest, OfTheServersOwnPageIsTaken) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080"}) {
    EXPECT_EQ(refusal(request(host), kLocal), "") << host;
    EXPECT_EQ(refusal(request(host, std::string("http://") + host, "same-origin"), kLocal), "");
  }
}

TEST(ARequest, OfAnotherOriginIsRefused) {
  for (const char* origin :
       {"http://evil.example", "http://127.0.0.1:8081", "https://127.0.0.1:8080", "null",
        "http://127.0.0.1:8080.evil.example"})
    EXPECT_NE(refusal(request("127.0.0.1:8080", origin), kLocal), "") << origin;
}

TEST(ARequest, UnderANameThatWasMadeToPointHereIsRefused) {
  EXPECT_NE(refusal(request("evil.example:8080", "http://evil.example:8080"), kLocal), "");
  EXPECT_NE(refusal(request("evil.example:8080", "http://evil.example:8080"), kWide), "");
  EXPECT_NE(refusal(request("", ""), kLocal), "");
  EXPECT_NE(refusal(request("192.168.1.5:8080"), kLocal), "");
}

TEST(ARequest, ToAServerForOthersComesByItsAddress) {
  EXPECT_EQ(refusal(request("192.168.1.5:8080", "http://192.168.1.5:8080"), kWide), "");
  EXPECT_NE(refusal(request("192.168.1.5:8080", "http://192.168.1.6:8080"), kWide), "");
}

TEST(ARequest, FromWithinAnotherSitesPageIsRefusedButALinkMayBeFollowed) {
  EXPECT_NE(refusal(request("127.0.0.1:8080", "", "cross-site", "no-cors"), kLocal), "");
  EXPECT_NE(refusal(request("127.0.0.1:8080", "", "same-site", "no-cors"), kLocal), "");
  EXPECT_EQ(refusal(request("127.0.0.1:8080", "", "none", "navigate"), kLocal), "");
  EXPECT_EQ(refusal(request("127.0.0.1:8080", "", "cross-site", "navigate"), kLocal), "");
}

TEST(ADoor, IsLocalOnlyOnALoopbackAddress) {
  EXPECT_TRUE(kLocal.local());
  EXPECT_TRUE((Door{"::1", 1}).local());
  EXPECT_FALSE(kWide.local());
  EXPECT_FALSE((Door{"192.168.1.5", 1}).local());
}

}  // namespace
}  // namespace fastball::view
