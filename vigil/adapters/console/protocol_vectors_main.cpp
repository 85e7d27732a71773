// protocol_vectors DIR: writes the conformance vectors of the protocol there.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "vigil/adapters/console/protocol_vectors.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: protocol_vectors DIR\n", stderr);
    return 2;
  }
  for (const auto& [name, text] : vigil::console::protocol_vectors()) {
    std::ofstream file(std::filesystem::path(argv[1]) / name, std::ios::binary);
    file << text;
    if (!file.flush()) return 3;
  }
  return 0;
}
