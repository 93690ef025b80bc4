#pragma once
/// Parsers of settings that are lists: API keys, signing keys, generators, origins. Each returns "" or an error
/// message that continues "the setting ..." and never repeats a secret.
#include <string>
#include <string_view>
#include <vector>

#include "server/signature.h"

namespace seedmesh {

/// The key of a client. The service stores only its SHA-256.
struct ApiKey {
  std::string name;
  std::string digest;    ///< 32 bytes
  double rate = -1;      ///< requests per second; 0: no limit, -1: the setting `key-rate`
  int concurrency = -1;  ///< concurrent requests; 0: no limit, -1: the setting `key-concurrency`
};

/// Splits a list at commas, white space and line ends. "#" begins a comment to the end of the line.
std::vector<std::string> list_elements(std::string_view text);

/// Resolves a setting that may refer to a file. Sets `text` to the text of the file for "@/run/secrets/keys",
/// else to the setting itself. Returns false where the file cannot be read.
bool read_indirect(std::string_view given, std::string& text);

/// Whether the text can be the name of a key: 1 to 64 letters, digits, - _ and .
bool is_key_name(std::string_view text);

/// Reads API keys such as "alice:<64 hex digits>" or "alice:<64 hex digits>:10:2". The parts are the name,
/// the SHA-256 of the key, the rate and the concurrency.
std::string read_api_keys(std::string_view text, std::vector<ApiKey>& keys);

/// Reads signing keys such as "2026a:<hex digits of at least 16 bytes>". The parts are the id and the secret.
/// The first key signs; all keys verify.
std::string read_signing_keys(std::string_view text, std::vector<SigningKey>& keys);

/// Reads "*", or origins such as https://example.org.
std::string read_origins(std::string_view text, std::vector<std::string>& origins);

/// Reads names of generators.
std::string read_generators(std::string_view text, std::vector<std::string>& generators);

}  // namespace seedmesh
