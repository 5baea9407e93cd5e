#include "messaging/type_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/dll/library_info.hpp>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "messaging/big_endian.h"
#include "messaging/command_trailer.h"

extern "C" {
#define FASTBALL_TYPE(name) const lcm_type_info_t* name##_get_type_info(void);
#include "lcmtypes/own_types.inc"
#undef FASTBALL_TYPE
}

namespace fastball::messaging {
namespace {

constexpr std::size_t kFingerprintBytes = 8;
/// A type may hold itself; a message nested deeper than this is not taken apart.
constexpr int kMaxDepth = 32;
const std::string kTypeInfo = "_get_type_info";

int64_t fingerprint(const void* data) {
  return static_cast<int64_t>(bigEndian({static_cast<const char*>(data), kFingerprintBytes}));
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::size_t agreement(const std::string& a, const std::string& b) {
  const auto shorter = static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.begin() + shorter, b.begin()).first -
                                  a.begin());
}

MessageField::Kind kindOf(lcm_field_type_t type) {
  using Kind = MessageField::Kind;
  switch (type) {
    case LCM_FIELD_INT16_T:
      return Kind::kInt16;
    case LCM_FIELD_INT32_T:
      return Kind::kInt32;
    case LCM_FIELD_INT64_T:
      return Kind::kInt64;
    case LCM_FIELD_BYTE:
      return Kind::kByte;
    case LCM_FIELD_FLOAT:
      return Kind::kFloat;
    case LCM_FIELD_DOUBLE:
      return Kind::kDouble;
    case LCM_FIELD_STRING:
      return Kind::kText;
    case LCM_FIELD_BOOLEAN:
      return Kind::kBoolean;
    default:
      return Kind::kInt8;
  }
}

}  // namespace

/// Walks over an encoded message by its type's own description. The generated decoder is not used: it believes every length.
/// A description reads the lengths of arrays from a decoded struct, so integers are put into one as they come by; the
/// rest of it stays zero.
class MessageWalk {
 public:
  MessageWalk(const TypeLibrary& library, const char* data, std::size_t size)
      : library_(library), next_(data), left_(static_cast<int64_t>(size)) {}

  bool message(const TypeLibrary::Type& type, const std::string& prefix, int depth) {
    if (depth > kMaxDepth)
      return false;
    const auto bytes = static_cast<std::size_t>(type.info->struct_size());
    std::vector<std::max_align_t> decoded(bytes / sizeof(std::max_align_t) + 1);
    for (int i = 0; i < type.info->num_fields(); ++i) {
      lcm_field_t description{};
      if (type.info->get_field(decoded.data(), i, &description) != 0 ||
          !field(type, prefix, description, depth))
        return false;
    }
    return true;
  }

  /// Nothing is left, but the trailer of a command.
  bool atEnd() const {
    return left_ == 0 ||
           (left_ == kTrailerBytes && hasTrailer(next_, static_cast<std::size_t>(left_)));
  }
  std::vector<MessageField> fields;

 private:
  bool field(const TypeLibrary::Type& type,
             const std::string& prefix,
             const lcm_field_t& description,
             int depth) {
    std::vector<int64_t> sizes(description.dim_size, description.dim_size + description.num_dim);
    const int64_t count = product(sizes);
    if (count < 0)
      return false;
    MessageField field(prefix + description.name, kindOf(description.type), std::move(sizes));
    if (description.type == LCM_FIELD_USER_TYPE)
      return nested(type, field, description.typestr, depth);
    if (field.isText() ? !texts(field) : !numbers(field))
      return false;
    if (field.sizes_.empty() && !field.isText() && !field.isReal())
      store(field, description.data);
    fields.push_back(std::move(field));
    return true;
  }

  /// @return -1 if there cannot be that many values, each of which takes at least a byte.
  int64_t product(const std::vector<int64_t>& sizes) const {
    int64_t product = 1;
    if (std::any_of(sizes.begin(), sizes.end(), [](int64_t size) { return size < 0; }))
      return -1;
    if (std::find(sizes.begin(), sizes.end(), 0) != sizes.end())
      return 0;
    for (const int64_t size : sizes) {
      product *= size;
      if (product > left_)
        return -1;
    }
    return product;
  }

  bool nested(const TypeLibrary::Type& parent,
              const MessageField& field,
              const char* last_name,
              int depth) {
    const TypeLibrary::Type* type = library_.nested(parent, last_name);
    if (type == nullptr)
      return false;
    for (std::size_t i = 0; i < field.count(); ++i) {
      if (!message(*type, field.elementName(i) + ".", depth + 1))
        return false;
    }
    return true;
  }

  bool numbers(MessageField& field) {
    field.data_ = next_;
    return skip(static_cast<int64_t>(field.count() * encodedBytes(field.kind())));
  }

  bool texts(MessageField& field) {
    for (std::size_t i = 0; i < field.count(); ++i) {
      MessageField length("", MessageField::Kind::kInt32, {});
      if (!numbers(length))
        return false;
      const int64_t bytes = length.integer(0);  // with the final zero
      if (bytes < 1 || bytes > left_)
        return false;
      field.texts_.emplace_back(next_, static_cast<std::size_t>(bytes - 1));
      skip(bytes);
    }
    return true;
  }

  bool skip(int64_t bytes) {
    if (bytes > left_)
      return false;
    next_ += bytes;
    left_ -= bytes;
    return true;
  }

  static void store(const MessageField& field, void* member) {
    switch (field.kind()) {
      case MessageField::Kind::kInt16:
        *static_cast<int16_t*>(member) = static_cast<int16_t>(field.integer(0));
        break;
      case MessageField::Kind::kInt32:
        *static_cast<int32_t*>(member) = static_cast<int32_t>(field.integer(0));
        break;
      case MessageField::Kind::kInt64:
        *static_cast<int64_t*>(member) = field.integer(0);
        break;
      default:
        *static_cast<int8_t*>(member) = static_cast<int8_t>(field.integer(0));
    }
  }

  const TypeLibrary& library_;
  const char* next_;
  int64_t left_;
};

TypeLibrary::TypeLibrary() {
#define FASTBALL_TYPE(name) add(#name, name##_get_type_info());
#include "lcmtypes/own_types.inc"
#undef FASTBALL_TYPE
}

void TypeLibrary::add(const std::string& name, const lcm_type_info_t* info) {
  by_fingerprint_.insert_or_assign(info->get_hash(), Type{name, info});
}

int TypeLibrary::load(const std::string& its_path) {
  // A name without a slash would be looked for in the system's folders only.
  const std::string path = std::filesystem::absolute(its_path).string();
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw std::invalid_argument(
        fmt::format("cannot load the type library '{}': {}", path, dlerror()));
  int types = 0;
  for (const std::string& symbol : boost::dll::library_info(path).symbols()) {
    if (!endsWith(symbol, kTypeInfo))
      continue;
    using GetTypeInfo = const lcm_type_info_t* (*)();
    const auto get = reinterpret_cast<GetTypeInfo>(dlsym(library, symbol.c_str()));
    if (get == nullptr)
      continue;
    add(symbol.substr(0, symbol.size() - kTypeInfo.size()), get());
    ++types;
  }
  if (types > 0)
    return types;
  throw std::invalid_argument(fmt::format(
      "'{}' holds no message type; it must be made of the output of lcm-gen --c --c-typeinfo",
      path));
}

const TypeLibrary::Type* TypeLibrary::typeOf(const void* data, std::size_t size) const {
  if (size < kFingerprintBytes)
    return nullptr;
  const auto found = by_fingerprint_.find(fingerprint(data));
  return found == by_fingerprint_.end() ? nullptr : &found->second;
}

std::optional<std::vector<MessageField>> TypeLibrary::fields(const void* data,
                                                             std::size_t size) const {
  const Type* type = typeOf(data, size);
  if (type == nullptr)
    return std::nullopt;
  MessageWalk walk(*this, static_cast<const char*>(data) + kFingerprintBytes,
                   size - kFingerprintBytes);
  if (!walk.message(*type, "", 0) || !walk.atEnd())
    return std::nullopt;
  return std::move(walk.fields);
}

const TypeLibrary::Type* TypeLibrary::nested(const Type& parent,
                                             const std::string& last_name) const {
  const Type* best = nullptr;
  for (const auto& [ignored, type] : by_fingerprint_) {
    if (type.name != last_name && !endsWith(type.name, "_" + last_name))
      continue;
    const auto rank = [&](const Type& t) {
      // Where two agree equally, the shorter name has nothing between package and last name.
      return std::pair(agreement(t.name, parent.name),
                       std::numeric_limits<std::size_t>::max() - t.name.size());
    };
    if (best == nullptr || rank(type) > rank(*best))
      best = &type;
  }
  return best;
}

}  // namespace fastball::messaging
