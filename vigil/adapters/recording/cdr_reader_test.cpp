#include "vigil/adapters/recording/cdr_reader.hpp"

#include <gtest/gtest.h>

#include "vigil/adapters/recording/cdr_writer.hpp"
#include "vigil/adapters/recording/own_messages.hpp"
#include "vigil/adapters/recording/recording_error.hpp"

namespace vigil::recording {
namespace {

std::vector<char> sample() {
  CdrWriter writer;
  writer.start(200);
  writer.put(std::uint8_t{7});
  writer.put(0.1);
  writer.put(std::string_view("text"));
  writer.sequence(std::span<const double>(std::array{1.0, 2.0, 3.0}));
  writer.seal();
  return {writer.message().begin(), writer.message().end()};
}

TEST(CdrReaderTest, Reads_what_was_written) {
  const std::vector<char> bytes = sample();
  CdrReader reader(bytes);
  EXPECT_EQ(reader.u8(), 7);
  EXPECT_EQ(reader.number(), 0.1);
  EXPECT_EQ(reader.text(), "text");
  EXPECT_EQ(reader.sequence<double>(), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_TRUE(is_sealed(bytes));
}

TEST(CdrReaderTest, Padding_is_zero_whatever_was_written_before) {
  CdrWriter writer;
  writer.start(64);
  for (int n = 0; n < 32; ++n) writer.put(std::uint8_t{255});
  writer.start(64);
  writer.put(std::uint8_t{1});
  writer.put(1.0);
  for (std::size_t n = 5; n < 12; ++n) EXPECT_EQ(writer.message()[n], '\0') << n;
}

TEST(CdrReaderTest, A_message_that_was_cut_off_is_refused_wherever) {
  const std::vector<char> bytes = sample();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<char> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(is_sealed(cut)) << size;
    const auto read = [&cut] {
      CdrReader reader(cut);
      (void)reader.u8();
      (void)reader.number();
      (void)reader.text();
      (void)reader.sequence<double>();
      (void)reader.u64();
    };
    EXPECT_THROW(read(), RecordingError) << size;
  }
}

TEST(CdrReaderTest, A_length_that_cannot_be_allocates_nothing) {
  CdrWriter writer;
  writer.start(64);
  writer.put(std::uint32_t{0xFFFFFFFF});
  const std::vector<char> bytes(writer.message().begin(), writer.message().end());
  EXPECT_THROW((void)CdrReader(bytes).sequence<double>(), RecordingError);
  EXPECT_THROW((void)CdrReader(bytes).text(), RecordingError);
}

TEST(CdrReaderTest, Any_flipped_bit_breaks_the_seal) {
  std::vector<char> bytes = sample();
  for (std::size_t n = 4; n < bytes.size(); ++n) {
    bytes[n] = static_cast<char>(bytes[n] ^ 16);
    EXPECT_FALSE(is_sealed(bytes)) << n;
    bytes[n] = static_cast<char>(bytes[n] ^ 16);
  }
}

}  // namespace
}  // namespace vigil::recording
