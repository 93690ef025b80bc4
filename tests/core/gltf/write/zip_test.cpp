#include "core/gltf/write/zip.h"

#include <gmock/gmock.h>
#include <zip.h>

#include <cstdlib>
#include <ctime>
#include <map>

#include "tests/core/gltf/samples.h"

namespace seedmesh {
namespace {

using namespace samples;
using ::testing::ElementsAre;

struct Unpacked {
  std::vector<std::string> names;
  std::map<std::string, std::string> files;
};

/// Opens an archive with libzip, which checks every CRC while it reads.
Unpacked unpack(const std::string& bytes) {
  Unpacked unpacked;
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* archive = zip_open_from_source(source, ZIP_CHECKCONS | ZIP_RDONLY, &error);
  EXPECT_NE(archive, nullptr) << zip_error_strerror(&error);
  if (!archive) return unpacked;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    zip_stat_t about;
    EXPECT_EQ(zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &about), 0);
    EXPECT_EQ(about.comp_method, ZIP_CM_STORE);
    std::string content(about.size, '\0');
    zip_file_t* file = zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0);
    EXPECT_EQ(zip_fread(file, content.data(), content.size()), static_cast<zip_int64_t>(content.size()));
    EXPECT_EQ(zip_fclose(file), 0);
    unpacked.names.emplace_back(about.name);
    unpacked.files[about.name] = std::move(content);
  }
  zip_close(archive);
  return unpacked;
}

Payload zip_of(Model model) {
  Job fresh = job();
  return write(std::move(model), Container::zip, "seedmesh test", fresh);
}

std::string noise(std::size_t size) {
  std::string bytes(size, '\0');
  Rng rng = Rng::of_seed(7).at("noise");
  for (char& each : bytes) each = static_cast<char>(rng.next());
  return bytes;
}

TEST(Zip, GivesBackWhatWasPutIn) {
  const std::string large = noise(1'000'003);
  std::vector<gltf::ZipEntry> entries(3);
  entries[0].name = "a.txt";
  entries[0].payload.add("hello");
  entries[1].name = "empty.txt";
  entries[2].name = "folder/large.bin";
  for (std::size_t i = 0; i < large.size(); i += 70'001) entries[2].payload.add(large.substr(i, 70'001));
  const Payload archive = gltf::zip(std::move(entries), job());
  const Unpacked unpacked = unpack(archive.text());
  EXPECT_THAT(unpacked.names, ElementsAre("a.txt", "empty.txt", "folder/large.bin"));
  EXPECT_EQ(unpacked.files.at("a.txt"), "hello");
  EXPECT_EQ(unpacked.files.at("empty.txt"), "");
  EXPECT_EQ(unpacked.files.at("folder/large.bin"), large);
}

TEST(Zip, PointsIntoItsEntriesInsteadOfCopyingThem) {
  auto large = std::make_shared<const std::string>(noise(500'000));
  std::vector<gltf::ZipEntry> entries(1);
  entries[0].name = "large.bin";
  entries[0].payload.add(large, std::as_bytes(std::span(*large)));
  const Payload archive = gltf::zip(std::move(entries), job());
  ASSERT_EQ(archive.pieces().size(), 3U) << "header, data, directory";
  EXPECT_EQ(static_cast<const void*>(archive.pieces()[1].data()), large->data());
  EXPECT_EQ(archive.pieces()[1].size(), large->size());
}

TEST(Zip, RefusesAnArchiveOfFourGibibytes) {
  const auto block = std::make_shared<const std::string>(std::size_t{1} << 20U, 'x');
  std::vector<gltf::ZipEntry> entries(1);
  entries[0].name = "large.bin";
  for (int i = 0; i < 4096; ++i) entries[0].payload.add(block, std::as_bytes(std::span(*block)));
  EXPECT_THROW((void)gltf::zip(std::move(entries), job()), Stop);
}

TEST(Zip, RefusesMoreFilesThanItsDirectoryCounts) {
  const auto archive_of = [](std::size_t count) {
    std::vector<gltf::ZipEntry> entries(count);
    for (std::size_t i = 0; i < count; ++i) entries[i].name = std::to_string(i);
    return gltf::zip(std::move(entries), job());
  };
  EXPECT_EQ(unpack(archive_of(65'535).text()).names.size(), 65'535U);
  EXPECT_THROW((void)archive_of(65'536), Stop);
}

TEST(Zip, HasTheChecksumOfTheStandard) {
  std::vector<gltf::ZipEntry> entries(1);
  entries[0].name = "check";
  entries[0].payload.add("1234");
  entries[0].payload.add("56789");
  // The check value of CRC-32 in Koopman's and Williams' catalogues: 0xCBF43926, at byte 14 of the header.
  EXPECT_EQ(gltf::zip(std::move(entries), job()).text().substr(14, 4), "\x26\x39\xF4\xCB");
}

TEST(Zip, DoesNotDependOnTheTimeOrItsZone) {
  const std::string first = zip_of(textured(job())).text();
  ::setenv("TZ", "Pacific/Auckland", 1);  // NOLINT(concurrency-mt-unsafe): the only thread
  ::tzset();
  const std::string second = zip_of(textured(job())).text();
  ::unsetenv("TZ");  // NOLINT(concurrency-mt-unsafe)
  ::tzset();
  EXPECT_EQ(first, second);
}

TEST(ZipContainer, ContainsDocumentBufferAndTextures) {
  Model model = textured(job());
  model.name = "Old oak/1";
  const Unpacked unpacked = unpack(zip_of(std::move(model)).text());
  EXPECT_THAT(unpacked.names,
              ElementsAre("Old_oak_1.gltf", "Old_oak_1.bin", "textures/bark.png", "textures/leaf.png"));
  const auto document = nlohmann::json::parse(unpacked.files.at("Old_oak_1.gltf"));
  EXPECT_EQ(document["buffers"][0]["uri"], "Old_oak_1.bin");
  EXPECT_EQ(document["buffers"][0]["byteLength"], unpacked.files.at("Old_oak_1.bin").size());
  EXPECT_EQ(document["images"][0]["uri"], "textures/bark.png");
  EXPECT_EQ(unpacked.files.at("textures/bark.png").substr(1, 3), "PNG");
}

TEST(ZipContainer, NamesImagesDifferently) {
  Model model = textured(job());
  model.textures = {pixel("bark"), pixel("b"), pixel("bark")};
  EXPECT_THAT(unpack(zip_of(std::move(model)).text()).names,
              ElementsAre("model.gltf", "model.bin", "textures/bark.png", "textures/bark_2.png"));
}

TEST(ZipContainer, HasOneDocumentForEachLevelOfDetail) {
  const Unpacked unpacked = unpack(zip_of(with_lods(job())).text());
  EXPECT_THAT(unpacked.names, ElementsAre("oak_tree.gltf", "oak_tree.bin", "oak_tree_LOD1.gltf",
                                          "oak_tree_LOD1.bin", "oak_tree_LOD2.gltf", "oak_tree_LOD2.bin"));
  const auto meshes = [&](const std::string& file) {
    const auto document = nlohmann::json::parse(unpacked.files.at(file));
    std::vector<std::string> names;
    for (const auto& mesh : document["meshes"]) names.push_back(mesh["name"]);
    return names;
  };
  EXPECT_THAT(meshes("oak_tree.gltf"), ElementsAre("shape0_mesh", "shape1_mesh"));
  EXPECT_THAT(meshes("oak_tree_LOD1.gltf"), ElementsAre("shape2_mesh", "shape1_mesh"));
  EXPECT_THAT(meshes("oak_tree_LOD2.gltf"), ElementsAre("shape3_mesh", "shape1_mesh"));
}

TEST(ZipContainer, NamesNodesByTheLevelOfTheirFile) {
  Model model = with_lods(job());
  for (Node& node : model.nodes) {
    if (!node.lods.empty()) node.name = "bark_LOD0";
  }
  const Unpacked unpacked = unpack(zip_of(std::move(model)).text());
  for (const auto& [file, name] : {std::pair{"oak_tree.gltf", "bark_LOD0"},
                                   {"oak_tree_LOD1.gltf", "bark_LOD1"},
                                   {"oak_tree_LOD2.gltf", "bark_LOD2"}})
    EXPECT_EQ(nlohmann::json::parse(unpacked.files.at(file))["nodes"][0]["name"], name);
}

TEST(ZipContainer, OfAnEmptyModelHasNoBuffer) {
  EXPECT_THAT(unpack(zip_of(Model{}).text()).names, ElementsAre("model.gltf"));
}

}  // namespace
}  // namespace seedmesh
