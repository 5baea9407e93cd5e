#include "messaging/command_key.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "messaging/command_trailer.h"

namespace fastball::messaging {
namespace {

static_assert(CommandKey::kBytes == crypto_generichash_KEYBYTES);
static_assert(kTagBytes == crypto_generichash_BYTES);

constexpr const char* kWhiteSpace = " \t\r\n";
constexpr std::size_t kMostFileBytes = 1024;

void startSodium() {
  if (sodium_init() < 0)
    throw std::runtime_error("libsodium finds no random numbers on this machine");
}

class File {
 public:
  File(const std::string& path, int flags)
      : descriptor_(open(path.c_str(), flags | O_CLOEXEC, S_IRUSR | S_IWUSR)) {}
  ~File() {
    if (descriptor_ >= 0)
      close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::invalid_argument(fmt::format("key file {}: {}", path, why));
}

std::string textOf(const std::string& path) {
  const File file(path, O_RDONLY | O_NONBLOCK);
  struct stat status {};
  if (file.descriptor() < 0 || fstat(file.descriptor(), &status) != 0)
    refuse(path, std::strerror(errno));
  if (!S_ISREG(status.st_mode))
    refuse(path, "is no file");
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    refuse(path,
           fmt::format("has mode {:04o}, so that others than its owner get at it; give `chmod "
                       "600 {}`, or make a new one with `fastball key`",
                       status.st_mode & 07777U, path));
  }
  std::string text(kMostFileBytes, '\0');
  const ssize_t n = ::read(file.descriptor(), text.data(), text.size());
  if (n < 0)
    refuse(path, std::strerror(errno));
  text.resize(static_cast<std::size_t>(n));
  return text;
}

/// True if the whole text is 32 bytes in one of the two notations.
bool parse(const std::string& text, std::array<uint8_t, CommandKey::kBytes>& bytes) {
  const char* const end = text.data() + text.size();
  std::size_t n = 0;
  const char* stop = nullptr;
  if (sodium_hex2bin(bytes.data(), bytes.size(), text.data(), text.size(), kWhiteSpace, &n,
                     &stop) == 0 &&
      n == bytes.size() && stop == end)
    return true;
  return sodium_base642bin(bytes.data(), bytes.size(), text.data(), text.size(), kWhiteSpace, &n,
                           &stop, sodium_base64_VARIANT_ORIGINAL) == 0 &&
         n == bytes.size() && stop == end;
}

}  // namespace

CommandKey::CommandKey(const std::array<uint8_t, kBytes>& bytes) : bytes_(bytes) {
  startSodium();
  constexpr std::string_view kWords = "the name of a key";
  std::array<uint8_t, kTagBytes> hash{};
  crypto_generichash(hash.data(), hash.size(),
                     reinterpret_cast<const unsigned char*>(kWords.data()), kWords.size(),
                     bytes_.data(), bytes_.size());
  id_ = fmt::format("{:02x}{:02x}{:02x}{:02x}", hash[0], hash[1], hash[2], hash[3]);
}

CommandKey::~CommandKey() {
  sodium_memzero(bytes_.data(), bytes_.size());
}

CommandKey CommandKey::read(const std::string& path) {
  startSodium();
  std::string text = textOf(path);
  std::array<uint8_t, kBytes> bytes{};
  const bool is_key = text.size() < kMostFileBytes && parse(text, bytes);
  sodium_memzero(text.data(), text.size());
  if (!is_key)
    refuse(path, fmt::format("holds no key of {} bytes in hexadecimal or base64; `fastball key` "
                             "makes one",
                             kBytes));
  const CommandKey key(bytes);
  sodium_memzero(bytes.data(), bytes.size());
  return key;
}

CommandKey CommandKey::make(const std::string& path) {
  startSodium();
  const File file(path, O_WRONLY | O_CREAT | O_EXCL);
  if (file.descriptor() < 0 && errno == EEXIST)
    refuse(path, "is there already; it is not overwritten");
  if (file.descriptor() < 0)
    throw std::runtime_error(fmt::format("key file {}: {}", path, std::strerror(errno)));
  std::array<uint8_t, kBytes> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  std::array<char, 2 * kBytes + 1> text{};
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  text.back() = '\n';
  const bool written =
      write(file.descriptor(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      fsync(file.descriptor()) == 0;
  const int fault = errno;
  sodium_memzero(text.data(), text.size());
  if (!written) {
    unlink(path.c_str());
    throw std::runtime_error(fmt::format("key file {}: {}", path, std::strerror(fault)));
  }
  const CommandKey key(bytes);
  sodium_memzero(bytes.data(), bytes.size());
  return key;
}

void CommandKey::tag(std::string_view channel,
                     const void* data,
                     std::size_t size,
                     uint8_t* tag) const {
  constexpr unsigned char kEndOfName = 0;
  crypto_generichash_state state;
  crypto_generichash_init(&state, bytes_.data(), bytes_.size(), kTagBytes);
  crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(channel.data()),
                            channel.size());
  crypto_generichash_update(&state, &kEndOfName, 1);
  crypto_generichash_update(&state, static_cast<const unsigned char*>(data), size);
  crypto_generichash_final(&state, tag, kTagBytes);
}

bool CommandKey::isTag(std::string_view channel,
                       const void* data,
                       std::size_t size,
                       const uint8_t* tag) const {
  std::array<uint8_t, kTagBytes> right{};
  this->tag(channel, data, size, right.data());
  return sodium_memcmp(right.data(), tag, kTagBytes) == 0;
}

}  // namespace fastball::messaging
