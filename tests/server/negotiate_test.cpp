#include "server/negotiate.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

TEST(AcceptEncoding, TakesTheMostPreferredAndOursAmongEquals) {
  EXPECT_EQ(choose_coding("gzip, deflate, br, zstd"), Coding::zstd);
  EXPECT_EQ(choose_coding("gzip, deflate, br, zstd", small_codings), Coding::br);
  EXPECT_EQ(choose_coding("br, gzip;q=0.5"), Coding::br);
  EXPECT_EQ(choose_coding("gzip, zstd;q=0.9, br;q=0"), Coding::gzip);
  EXPECT_EQ(choose_coding("ZSTD;q=0.001"), Coding::zstd);
  EXPECT_EQ(choose_coding("br;q=0.5, identity"), Coding::identity);
  const Coding only_gzip[] = {Coding::gzip};
  EXPECT_EQ(choose_coding("br, gzip;q=0.1", only_gzip), Coding::gzip);
}

TEST(AcceptEncoding, TakesGzipWhereItIsWelcome) {
  EXPECT_EQ(choose_coding("gzip"), Coding::gzip);
  EXPECT_EQ(choose_coding("GZIP ; q=1.0"), Coding::gzip);
  EXPECT_EQ(choose_coding("*"), Coding::gzip);
}

TEST(AcceptEncoding, StaysPlainWhereGzipIsNotNamedOrForbidden) {
  EXPECT_EQ(choose_coding(""), Coding::identity);
  EXPECT_EQ(choose_coding("compress, deflate"), Coding::identity);
  EXPECT_EQ(choose_coding("gzip;q=0"), Coding::identity);
  EXPECT_EQ(choose_coding("gzip;q=0, *"), Coding::identity);
  EXPECT_EQ(choose_coding("identity, gzip;q=0.5"), Coding::identity);
  EXPECT_EQ(choose_coding("gzip;q=nonsense"), Coding::identity);
}

TEST(AcceptEncoding, FindsNothingWhereAllAreForbidden) {
  EXPECT_EQ(choose_coding("identity;q=0"), std::nullopt);
  EXPECT_EQ(choose_coding("*;q=0"), std::nullopt);
  EXPECT_EQ(choose_coding("deflate, identity;q=0, gzip;q=0"), std::nullopt);
  EXPECT_EQ(choose_coding("identity;q=0, gzip;q=0.1"), Coding::gzip);
}

TEST(Accept, AcceptsEventsOnlyByName) {
  EXPECT_TRUE(wants_events("text/event-stream"));
  EXPECT_TRUE(wants_events("model/gltf-binary, Text/Event-Stream; q=0.3"));
  EXPECT_FALSE(wants_events("*/*"));
  EXPECT_FALSE(wants_events("text/*"));
  EXPECT_FALSE(wants_events("text/event-stream;q=0"));
  EXPECT_FALSE(wants_events(""));
}

TEST(ContentType, TakesJsonInUtf8) {
  EXPECT_TRUE(is_json_type("application/json"));
  EXPECT_TRUE(is_json_type("Application/JSON; charset=UTF-8"));
  EXPECT_TRUE(is_json_type("application/vnd.seedmesh+json"));
  EXPECT_TRUE(is_json_type(""));
  EXPECT_FALSE(is_json_type("text/plain"));
  EXPECT_FALSE(is_json_type("application/json; charset=latin1"));
  EXPECT_FALSE(is_json_type("application/x-www-form-urlencoded"));
  EXPECT_FALSE(is_json_type(";charset=utf-8"));
  EXPECT_FALSE(is_json_type("+json"));
  for (const char* type :
       {"", "text/plain", "TEXT/PLAIN; charset=utf-8", "application/octet-stream", "application/json"}) {
    EXPECT_TRUE(is_text_or_json_type(type)) << type;
  }
  for (const char* type : {"text/html", "text/plain; charset=latin1", "application/x-www-form-urlencoded"}) {
    EXPECT_FALSE(is_text_or_json_type(type)) << type;
  }
}

TEST(Tag, ChangesWithRequestAndEngine) {
  const std::string tag = tag_of("{}", "1");
  EXPECT_EQ(tag.size(), 32U);
  EXPECT_EQ(tag, tag_of("{}", "1"));
  EXPECT_NE(tag, tag_of("{ }", "1"));
  EXPECT_NE(tag, tag_of("{}", "2"));
}

TEST(IfNoneMatch, IgnoresTheCoding) {
  const std::string tag = tag_of("{}", "1");
  EXPECT_TRUE(matches(etag(tag, Coding::identity), tag));
  for (const Coding coding : {Coding::gzip, Coding::br, Coding::zstd})
    EXPECT_TRUE(matches(etag(tag, coding), tag));
  EXPECT_TRUE(matches("\"other\", W/" + etag(tag, Coding::identity), tag));
  EXPECT_TRUE(matches("\"" + tag + "-gzip\"", tag)) << "a proxy may have made it strong";
  EXPECT_FALSE(matches("\"" + tag + "-lzma\"", tag));
  EXPECT_FALSE(matches("\"", tag));
  EXPECT_TRUE(matches("*", tag));
  EXPECT_FALSE(matches("", tag));
  EXPECT_FALSE(matches("\"other\"", tag));
  EXPECT_FALSE(matches(tag, tag)) << "a tag without quotes is none";
}

TEST(Range, IsCutToTheBody) {
  ByteRange range;
  ASSERT_EQ(read_range("bytes=2-5", 10, range), RangeKind::one);
  EXPECT_EQ(range.first, 2U);
  EXPECT_EQ(range.last, 5U);
  ASSERT_EQ(read_range("bytes=7-", 10, range), RangeKind::one);
  EXPECT_EQ(range.first, 7U);
  EXPECT_EQ(range.last, 9U);
  ASSERT_EQ(read_range("bytes=-3", 10, range), RangeKind::one);
  EXPECT_EQ(range.first, 7U);
  ASSERT_EQ(read_range("bytes=0-99999999999999999999", 10, range), RangeKind::none);
  ASSERT_EQ(read_range("bytes=5-99", 10, range), RangeKind::one);
  EXPECT_EQ(range.last, 9U);
}

TEST(Range, BeyondTheBodyCannotBeHad) {
  ByteRange range;
  EXPECT_EQ(read_range("bytes=10-", 10, range), RangeKind::unsatisfiable);
  EXPECT_EQ(read_range("bytes=-0", 10, range), RangeKind::unsatisfiable);
  EXPECT_EQ(read_range("bytes=0-", 0, range), RangeKind::unsatisfiable);
}

TEST(Range, OfAnotherKindIsIgnored) {
  ByteRange range;
  for (const char* text :
       {"", "bytes", "bytes=", "bytes=a-b", "bytes=5-2", "lines=1-2", "bytes=0-1,3-4", "bytes=5"}) {
    EXPECT_EQ(read_range(text, 10, range), RangeKind::none) << text;
  }
}

}  // namespace
}  // namespace seedmesh
