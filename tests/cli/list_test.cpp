// What `lamp` says of itself: the welcome, the help, the version, the lists.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

using List = CliTest;

TEST_F(List, WithoutArgumentsItWelcomes) {
  const std::string text = output_of({});
  for (const char* command :
       {"lamp render", "lamp verify", "lamp compare", "lamp bench", "lamp list methods", "--help"})
    EXPECT_NE(text.find(command), std::string::npos) << command;
}

TEST_F(List, EveryHelpHasExamples) {
  for (const Arguments& command : {Arguments{}, Arguments{"render"}, Arguments{"verify"}, Arguments{"compare"},
                                   Arguments{"capture"}, Arguments{"bench"}, Arguments{"report"}, Arguments{"info"},
                                   Arguments{"list"}, Arguments{"probe"}, Arguments{"completion"}, Arguments{"help"}}) {
    Arguments help = command;
    help.emplace_back("--help");
    const std::string text = output_of(help);
    const std::size_t examples = text.find("Examples:\n  lamp ");
    ASSERT_NE(examples, std::string::npos) << text;
    EXPECT_NE(text.find("Usage: lamp"), std::string::npos) << text;
    const std::string name = command.empty() ? "lamp render" : "lamp " + command[0];
    EXPECT_NE(text.find(name, examples), std::string::npos) << "no example of " << name;
    EXPECT_EQ(text.find("\n\n\n"), std::string::npos);
    Arguments in_words{"help"};
    in_words.insert(in_words.end(), command.begin(), command.end());
    EXPECT_EQ(output_of(in_words), text);
  }
}

TEST_F(List, OneMethodWithItsOptions) {
  const std::string text = output_of({"list", "methods", "tiled"});
  for (const char* part : {"tiled", "Stewart", "tile ", "8 | 16 | 32", "default 16"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("clustered"), std::string::npos);
  const std::string bins = output_of({"list", "methods", "drobot-zbin"});
  EXPECT_NE(bins.find("last bin"), std::string::npos) << bins;
  EXPECT_EQ(bins.find("slice"), std::string::npos) << bins;
  EXPECT_EQ(json_of({"list", "methods", "tiled", "--json"}), json_of({"list", "methods", "--json"}).at(1));
}

TEST_F(List, VersionIsTheProjects) {
  EXPECT_EQ(output_of({"--version"}), "lamp " LAMP_VERSION "\n");
  EXPECT_NE(output_of({"--help"}).find("--version"), std::string::npos);
  EXPECT_NE(output_of({}).find("lamp --version"), std::string::npos);
}

void expect_keys(const nlohmann::json& object, const std::vector<const char*>& keys) {
  for (const char* key : keys) EXPECT_TRUE(object.contains(key)) << key << " is not in " << object.dump();
}

TEST_F(List, LookUpsOfEveryMethodAreFiles) {
  const nlohmann::json lookups = json_of({"list", "lookups", "--json"});
  std::map<std::string, nlohmann::json> defaults;
  for (const nlohmann::json& row : lookups) {
    expect_keys(row, {"constants", "bindings"});
    for (const char* language : {".glsl", ".hlsl"}) {
      const std::string file = row.at("lookup").get<std::string>() + language;
      EXPECT_TRUE(std::filesystem::exists(LAMPLIGHT_SOURCE_DIR "/lib/shaders/lookup/" + file)) << file;
    }
    if (row.at("options").empty()) defaults.emplace(row.at("method"), row);
  }
  for (const nlohmann::json& method : json_of({"list", "methods", "--json"})) {
    const nlohmann::json& row = defaults.at(method.at("name"));
    const auto lookup = row.at("lookup").get<std::string>();
    EXPECT_TRUE(lookup.starts_with(method.at("result").get<std::string>())) << lookup;
    for (const char* key : {"ordered", "approximate", "needs_depth", "any_depth", "any_point"})
      EXPECT_EQ(row.at(key), method.at(key)) << method.at("name") << ": " << key;
  }
  EXPECT_TRUE(defaults.at("world-cells").at("any_point"));
  EXPECT_FALSE(defaults.at("clustered").at("any_point"));
  const std::string text = output_of({"list", "lookups"});
  EXPECT_NE(text.find("tiled container=bits walk=scalar-entity"), std::string::npos);
  EXPECT_NE(text.find("takes a position"), std::string::npos);
}

TEST_F(List, MethodsAsJson) {
  const nlohmann::json methods = json_of({"list", "methods", "--json"});
  ASSERT_TRUE(methods.is_array());
  std::set<std::string> names;
  for (const nlohmann::json& method : methods) {
    expect_keys(method, {"name", "title", "source", "summary", "result", "ordered", "approximate", "options"});
    names.insert(method.value("name", ""));
    EXPECT_TRUE(method.at("ordered").is_boolean());
    EXPECT_TRUE(method.at("approximate").is_boolean());
    for (const nlohmann::json& option : method.at("options")) {
      expect_keys(option, {"key", "help", "default"});
      EXPECT_NE(option.contains("choices"), option.contains("min") && option.contains("max")) << option.dump();
    }
  }
  EXPECT_EQ(names.size(), methods.size());
  for (const char* name : {"all", "tiled", "tiled-bits", "clustered"}) EXPECT_TRUE(names.contains(name)) << name;
}

TEST_F(List, MethodsAsTextNameAllOfThem) {
  const std::string text = output_of({"list", "methods"});
  for (const nlohmann::json& method : json_of({"list", "methods", "--json"}))
    for (const char* key : {"name", "title", "source"})
      EXPECT_NE(text.find(method.at(key).get<std::string>()), std::string::npos) << method.at(key);
}

TEST_F(List, Scenes) {
  const nlohmann::json scenes = json_of({"list", "scenes", "--json"});
  const std::string text = output_of({"list", "scenes"});
  ASSERT_TRUE(scenes.is_array());
  EXPECT_EQ(scenes.size(), 11U);
  for (const nlohmann::json& scene : scenes) {
    expect_keys(scene, {"name", "summary"});
    EXPECT_NE(text.find(scene.at("name").get<std::string>()), std::string::npos);
  }
}

TEST_F(List, Devices) {
  const nlohmann::json devices = json_of({"list", "devices", "--json"});
  ASSERT_TRUE(devices.is_array());
  ASSERT_FALSE(devices.empty()) << "tests need a Vulkan device, such as lavapipe";
  for (const nlohmann::json& device : devices) {
    expect_keys(device, {"name", "kind", "driver", "usable", "problem"});
    EXPECT_EQ(device.at("usable").get<bool>(), device.at("problem").get<std::string>().empty());
  }
  EXPECT_NE(output_of({"list", "devices"}).find(devices[0].at("name").get<std::string>()), std::string::npos);
}

TEST_F(List, Pipelines) {
  const nlohmann::json list = json_of({"list", "pipelines", "all", "--json"});
  expect_keys(list, {"device", "driver", "pipelines"});
  std::set<std::string> uses;
  for (const nlohmann::json& pipeline : list.at("pipelines")) {
    expect_keys(pipeline, {"method", "option", "use", "name", "executables"});
    uses.insert(pipeline.at("name").get<std::string>() + ": " + pipeline.at("use").get<std::string>());
  }
  EXPECT_EQ(uses.size(), list.at("pipelines").size()) << "two are told apart by nothing";
  for (const char* use : {"deferred shading: deferred", "forward+: forward", "forward+, captured: forward, captured",
                          "transparent: forward, Blinn-Phong", "light volumes: standard-deferred", "decals: "})
    EXPECT_TRUE(uses.contains(use)) << use;
  EXPECT_NE(output_of({"list", "pipelines", "all"}).find("\nall: forward+ (forward)\n"), std::string::npos);
}

TEST_F(List, PipelinesOfNoMethod) {
  expect_error(BAD_INPUT, {"list", "pipelines", "til"}, {"til", "tiled"});
  expect_error(BAD_INPUT, {"list", "methods", "--device", "0"}, {"--device", "pipelines"});
}

}  // namespace
}  // namespace lamp::cli
