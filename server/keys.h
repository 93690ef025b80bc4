#pragma once
/// Settings that are lists: API keys, signing keys, names, origins. Each reader gives "" or what is wrong
/// with the text, and never repeats a secret.
#include <string>
#include <string_view>
#include <vector>

#include "server/signature.h"

namespace seedmesh {

/// A client's right to ask. The service knows the key's SHA-256 alone.
struct ApiKey {
  std::string name;
  std::string digest;    ///< 32 bytes
  double rate = -1;      ///< requests a second; 0 = any number, -1 = what the setting `key-rate` says
  int concurrency = -1;  ///< requests at once; 0 = any number, -1 = what `key-concurrency` says
};

/// The elements of a list: separated by commas, white space or line ends; "#" begins a comment that ends with
/// its line.
std::vector<std::string> list_elements(std::string_view text);

/// What a setting holds that may also stand in a file: the file's text for "@/run/secrets/keys", else the
/// text itself. False where the file cannot be read.
bool read_indirect(std::string_view given, std::string& text);

/// "alice:<64 hex digits>", "alice:<64 hex digits>:10:2": name, SHA-256 of the key, rate, concurrency.
std::string read_api_keys(std::string_view text, std::vector<ApiKey>& keys);

/// "2026a:<hex digits of at least 16 bytes>": id, secret. The first signs, all verify.
std::string read_signing_keys(std::string_view text, std::vector<SigningKey>& keys);

/// "*", or origins such as https://example.org.
std::string read_origins(std::string_view text, std::vector<std::string>& origins);

/// Names of generators that there are.
std::string read_generators(std::string_view text, std::vector<std::string>& generators);

}  // namespace seedmesh
