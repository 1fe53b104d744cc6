#include "common/yaml_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dipper {
namespace {

using testing::ElementsAre;

class YamlSections : public testing::Test {
 protected:
  YamlSection file(const std::string& text) {
    tree_ = parse_yaml(text, "f.yaml", "", findings_);
    return {tree_, "", findings_};
  }
  std::vector<std::string> said() const {
    std::vector<std::string> out;
    for (const Finding& f : findings_) out.push_back(to_string(f));
    return out;
  }
  YamlTree tree_;
  std::vector<Finding> findings_;
};

TEST_F(YamlSections, GiveWhatIsThere) {
  YamlSection f = file("name: a\nbox:\n  min: [1, +2, -3e0]\n  size: 4\n");
  EXPECT_EQ(f.text("name", "a name"), "a");
  YamlSection box = f.section("box", "its sides");
  EXPECT_EQ(box.vector("min", "three numbers"), Eigen::Vector3d(1, 2, -3));
  EXPECT_EQ(box.number("size", "a number", {0, 4}), 4);
  EXPECT_EQ(box.find("max"), nullptr);
  box.refuse_others();
  f.refuse_others();
  EXPECT_THAT(said(), ElementsAre());
}

TEST_F(YamlSections, NoteEachFaultWithItsLineAndKey) {
  YamlSection f = file("box:\n  min: [1, x, 3]\n  size: 0x10\n  far: 9\n  max: 7\nlist: 3\n");
  YamlSection box = f.section("box", "its sides");
  box.vector("min", "three numbers");
  box.vector("max", "three numbers");
  box.number("size", "a number");
  box.number("far", "a number", {0, 4});
  box.text("name", "a name");
  YamlSection none = f.section("none", "a section");
  none.number("x", "a number");  // reported once: the section is missing
  f.section("list", "min and max");
  box.refuse_others();
  f.refuse_others();
  EXPECT_THAT(said(), ElementsAre("f.yaml:2: box.min.1: is 'x'; write three numbers",
                                  "f.yaml:5: box.max: is '7'; write three numbers",
                                  "f.yaml:3: box.size: is '0x10'; write a number",
                                  "f.yaml:4: box.far: 9 is out of range; allowed is 0 ... 4",
                                  "f.yaml:1: box.name: missing key; write a name",
                                  "f.yaml:1: none: missing key; write a section",
                                  "f.yaml:6: list: is '3'; write min and max"));
}

TEST_F(YamlSections, RefuseUnknownKeysAndKeysGivenTwice) {
  YamlSection f = file("a: 1\nb: 2\na: 3\n");
  EXPECT_EQ(f.number("a", "a number"), 1);
  f.refuse_others();
  EXPECT_THAT(said(), ElementsAre("f.yaml:3: a: given twice, first in line 1; keep one of the two",
                                  "f.yaml:2: b: unknown key; known are a"));
}

TEST_F(YamlSections, AnEmptyFileHasALineToo) {
  file("");
  EXPECT_THAT(said(), ElementsAre("f.yaml:1: is nothing; write a section of keys"));
}

}  // namespace
}  // namespace dipper
