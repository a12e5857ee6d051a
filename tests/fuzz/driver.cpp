// Runs a fuzz target without libFuzzer, with any compiler, on the files of a corpus and on seeded
// random mutations of them.
//   fuzz_NAME FILE|FOLDER... [--mutations N] [--seed S]
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

namespace fs = std::filesystem;
using Input = std::vector<uint8_t>;

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  size_t below(size_t count) {  // splitmix64
    uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return (z ^ (z >> 31)) % std::max<size_t>(count, 1);
  }

 private:
  uint64_t state_;
};

// Makes one to eight small changes: of bytes and numbers, and by parts that are removed, repeated
// or copied from another file.
Input changed(const std::vector<Input>& corpus, Random& random) {
  Input out = corpus[random.below(corpus.size())];
  static const std::string kTexts[] = {"0",    "-1", "4294967295", "1e39", "null",
                                       "[]",   "{}", "\"\"",       "true", "18446744073709551616",
                                       "../x", "nan"};
  for (size_t n = 1 + random.below(8); n > 0; --n) {
    const size_t at = random.below(out.size() + 1);
    const auto place = out.begin() + static_cast<std::ptrdiff_t>(at);
    const size_t length = std::min(random.below(64), out.size() - at);
    const auto end = place + static_cast<std::ptrdiff_t>(length);
    switch (random.below(6)) {
      case 0:
        if (at < out.size()) *place = static_cast<uint8_t>(random.below(256));
        break;
      case 1:
        if (at < out.size()) *place ^= static_cast<uint8_t>(1u << random.below(8));
        break;
      case 2:
        out.erase(place, end);
        break;
      case 3: {
        const Input part(place, end);
        out.insert(out.begin() + static_cast<std::ptrdiff_t>(at), part.begin(), part.end());
        break;
      }
      case 4: {
        const std::string& text = kTexts[random.below(std::size(kTexts))];
        // Replaces the next number, if there is one.
        auto from = std::find_if(place, out.end(), [](uint8_t c) { return c >= '0' && c <= '9'; });
        auto to = std::find_if(from, out.end(), [](uint8_t c) { return c < '0' || c > '9'; });
        const auto index = from - out.begin();
        out.erase(from, to);
        out.insert(out.begin() + index, text.begin(), text.end());
        break;
      }
      default: {
        const Input& other = corpus[random.below(corpus.size())];
        const size_t from = random.below(other.size() + 1);
        const size_t count = std::min(random.below(128), other.size() - from);
        out.insert(place, other.begin() + static_cast<std::ptrdiff_t>(from),
                   other.begin() + static_cast<std::ptrdiff_t>(from + count));
      }
    }
  }
  return out;
}

Input bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<fs::path> files;
  size_t mutations = 0;
  uint64_t seed = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--mutations" && i + 1 < argc)
      mutations = std::strtoull(argv[++i], nullptr, 10);
    else if (word == "--seed" && i + 1 < argc)
      seed = std::strtoull(argv[++i], nullptr, 10);
    else if (fs::is_directory(word))
      for (const auto& entry : fs::directory_iterator(word))
        files.push_back(fs::absolute(entry.path()));
    else
      files.push_back(fs::absolute(word));
  }
  std::sort(files.begin(), files.end());
  std::vector<Input> corpus;
  for (const fs::path& file : files) {
    corpus.push_back(bytesOf(file));
    std::fprintf(stderr, "%s\n", file.filename().c_str());
    LLVMFuzzerTestOneInput(corpus.back().data(), corpus.back().size());
  }
  if (corpus.empty()) corpus.emplace_back();
  Random random(seed);
  const char* keep = std::getenv("LAMPLIGHTER_FUZZ_LAST");  // a file for the latest input
  for (size_t i = 0; i < mutations; ++i) {
    const Input input = changed(corpus, random);
    if (keep != nullptr)
      std::ofstream(keep, std::ios::binary)
          .write(reinterpret_cast<const char*>(input.data()),
                 static_cast<std::streamsize>(input.size()));
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::printf("%zu files, %zu random changes of them\n", files.size(), mutations);
  return 0;
}
