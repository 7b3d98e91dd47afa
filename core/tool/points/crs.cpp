#include "tool/points/crs.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tool/program/letter_case.hpp"

namespace polylidar::tool {
namespace {

constexpr int kWgs84 = 4326;

/// Of numbers in EPSG's register every `step`-th one.
struct Numbers {
  int first;
  int last;
  int step = 1;

  bool has(int number) const { return number >= first && number <= last && (number - first) % step == 0; }
};

/// The geographic systems of EPSG's register in version 10.076 of 2022-08-31, in two and three dimensions,
/// also those that are no longer used: of PROJ 9.1.1, proj.db, geodetic_crs with the types "geographic 2D"
/// and "geographic 3D". No other system of that register has a number in these ranges.
constexpr auto kGeographic = std::to_array<Numbers>(
    {{3819, 3821},    {3823, 3824},    {3888, 3889},    {3906, 3906},    {4001, 4025},    {4027, 4036},
     {4040, 4047},    {4052, 4055},    {4074, 4075},    {4080, 4081},    {4120, 4216},    {4218, 4327},
     {4329, 4329},    {4339, 4383, 2}, {4386, 4386},    {4388, 4388},    {4463, 4463},    {4466, 4466},
     {4469, 4470},    {4472, 4472},    {4475, 4475},    {4480, 4480},    {4482, 4483},    {4490, 4490},
     {4555, 4555},    {4557, 4558},    {4600, 4646},    {4657, 4765},    {4801, 4811},    {4813, 4821},
     {4823, 4824},    {4883, 4895, 2}, {4898, 4898},    {4900, 4904},    {4907, 4907},    {4909, 4909},
     {4921, 4999, 2}, {5012, 5013},    {5132, 5132},    {5228, 5233},    {5245, 5246},    {5251, 5252},
     {5263, 5264},    {5323, 5324},    {5340, 5340},    {5342, 5342},    {5353, 5354},    {5359, 5360},
     {5364, 5365},    {5370, 5373},    {5380, 5381},    {5392, 5393},    {5451, 5451},    {5464, 5464},
     {5467, 5467},    {5488, 5489},    {5524, 5527},    {5545, 5546},    {5560, 5561},    {5592, 5593},
     {5681, 5681},    {5830, 5830},    {5885, 5886},    {6134, 6135},    {6207, 6207},    {6310, 6311},
     {6318, 6319},    {6321, 6322},    {6324, 6325},    {6364, 6365},    {6667, 6668},    {6705, 6706},
     {6782, 6783},    {6881, 6883},    {6892, 6892},    {6894, 6894},    {6979, 6980},    {6982, 6983},
     {6986, 6987},    {6989, 6990},    {7034, 7042},    {7072, 7073},    {7084, 7088},    {7133, 7133},
     {7135, 7136},    {7138, 7139},    {7372, 7373},    {7657, 7665, 2}, {7678, 7678},    {7680, 7680},
     {7682, 7683},    {7685, 7686},    {7797, 7798},    {7816, 7816},    {7843, 7844},    {7880, 7881},
     {7885, 7886},    {7900, 7912},    {7915, 7931, 2}, {8042, 8043},    {8085, 8086},    {8231, 8232},
     {8235, 8237},    {8239, 8240},    {8244, 8246},    {8248, 8249},    {8251, 8252},    {8254, 8255},
     {8351, 8351},    {8399, 8399},    {8403, 8403},    {8426, 8428},    {8430, 8431},    {8449, 8449},
     {8542, 8542},    {8544, 8545},    {8684, 8685},    {8694, 8694},    {8698, 8699},    {8817, 8818},
     {8860, 8860},    {8888, 8888},    {8899, 8902},    {8906, 8907},    {8916, 8946, 2}, {8948, 8949},
     {8972, 9000},    {9002, 9003},    {9005, 9006},    {9008, 9009},    {9011, 9014},    {9016, 9019},
     {9053, 9069},    {9071, 9072},    {9074, 9075},    {9139, 9140},    {9147, 9148},    {9152, 9153},
     {9183, 9184},    {9248, 9248},    {9251, 9251},    {9253, 9253},    {9267, 9267},    {9293, 9294},
     {9299, 9299},    {9308, 9309},    {9332, 9333},    {9364, 9364},    {9372, 9372},    {9379, 9384},
     {9403, 9403},    {9453, 9453},    {9469, 9470},    {9474, 9475},    {9546, 9547},    {9695, 9696},
     {9701, 9702},    {9739, 9739},    {9754, 9758},    {9763, 9763},    {9776, 9779},    {9781, 9784},
     {9866, 9866},    {9871, 9871},    {9893, 9893},    {9939, 9939},    {9964, 9964},    {9969, 9969},
     {9974, 9974},    {9989, 9990},    {20033, 20033},  {20040, 20041}});

/// Those of a geographic and a vertical system: likewise, compound_crs.
constexpr auto kGeographicWithHeights = std::to_array<Numbers>(
    {{5498, 5500}, {5628, 5628}, {5942, 5942}, {6144, 6144},   {6349, 6349},   {6649, 6649},
     {6696, 6697}, {6700, 6700}, {6917, 6917}, {7400, 7400},   {7404, 7404},   {7406, 7406},
     {7408, 7410}, {7414, 7414}, {7423, 7423}, {8349, 8350},   {8360, 8360},   {9286, 9286},
     {9289, 9290}, {9422, 9430}, {9449, 9450}, {9452, 9452},   {9462, 9464},   {9500, 9544},
     {9656, 9657}, {9705, 9705}, {9707, 9707}, {9723, 9725},   {9785, 9785},   {9883, 9883},
     {9907, 9907}, {9924, 9924}, {9948, 9950}, {20001, 20001}, {20037, 20038}, {20043, 20043}});

/// Of all these, those in grads: the unit of their axes is 9105.
constexpr auto kInGrads = std::to_array<int>({4807, 4810, 4811, 4816, 4819, 4821, 4901, 4902, 7400});

bool has_grads(int number) {
  return std::find(kInGrads.begin(), kInGrads.end(), number) != kInGrads.end();
}

std::optional<int> number_of(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number <= 0) return {};
  return number;
}

/// The number that the whole of `text` is.
std::optional<double> real_number_of(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Whether `text`, which says how many radians a unit has, says those of a degree or nothing. Some programs
/// write few digits.
bool may_be_degree(std::string_view text) {
  constexpr double kDegree = std::numbers::pi / 180;
  return std::abs(real_number_of(text).value_or(kDegree) - kDegree) <= 0.01 * kDegree;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// An open bracket of well-known text.
struct Node {
  std::string keyword;
  std::vector<std::string> values;  ///< between the commas, without quotes; nodes inside are none
};

/// Of the systems that most files have: "WGS 84 / UTM zone 32N", in Esri's spelling "WGS_1984_UTM_Zone_32N".
/// 0 for another name.
int number_of_known_name(std::string_view name) {
  struct Datum {
    std::string_view name;
    int degrees;  ///< its number with longitude and latitude
    int north;    ///< of UTM's zones: this plus the zone
    int south;    ///< likewise; 0: there are none
    int first_zone;
    int last_zone;
  };
  static constexpr std::array<Datum, 7> kDatums = {{{"WGS84", 4326, 32600, 32700, 1, 60},
                                                    {"WGS1984", 4326, 32600, 32700, 1, 60},
                                                    {"ETRS89", 4258, 25800, 0, 28, 37},
                                                    {"ETRS1989", 4258, 25800, 0, 28, 37},
                                                    {"NAD83", 4269, 26900, 0, 1, 23},
                                                    {"NAD1983", 4269, 26900, 0, 1, 23},
                                                    {"NORTHAMERICAN1983", 4269, 0, 0, 1, 0}}};
  std::string plain = upper_case(std::string(name));
  std::erase_if(plain, [](unsigned char c) { return std::isalnum(c) == 0; });
  std::string_view rest = plain;
  if (rest.starts_with("GCS")) rest.remove_prefix(3);
  for (const Datum& datum : kDatums) {
    if (!rest.starts_with(datum.name)) continue;
    std::string_view zone = rest.substr(datum.name.size());
    if (zone.empty()) return datum.degrees;
    if (!zone.starts_with("UTMZONE")) continue;
    zone.remove_prefix(7);
    const int base = zone.ends_with('N') ? datum.north : zone.ends_with('S') ? datum.south : 0;
    zone.remove_suffix(std::min<std::size_t>(zone.size(), 1));
    const std::optional<int> number = number_of(zone);
    if (base > 0 && number && *number >= datum.first_zone && *number <= datum.last_zone)
      return base + *number;
  }
  return 0;
}

/// Whether the innermost node gives the geographic system at this depth another unit than degrees. That of
/// its prime meridian may be another one.
bool gives_other_unit(const std::vector<Node>& open, std::size_t depth) {
  const Node& node = open.back();
  const bool is_own = open.size() == depth + 1 && is_one_of(node.keyword, {"UNIT", "ANGLEUNIT"});
  const bool is_of_axis =
      open.size() == depth + 2 && node.keyword == "ANGLEUNIT" && open[depth].keyword == "AXIS";
  return (is_own || is_of_axis) && node.values.size() >= 2 && !may_be_degree(node.values[1]);
}

/// The horizontal system, without the text.
std::optional<Crs> horizontal_system(std::string_view text) {
  std::vector<Node> open;
  std::optional<Crs> found;
  std::size_t depth_of_found = 0;
  bool is_in_metres = true;  // a system of the same name in feet is another one
  std::string word;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      const std::size_t end = std::min(text.find('"', i + 1), text.size());
      word = text.substr(i + 1, end - i - 1);
      i = end;
    } else if (c == '[' || c == '(') {
      open.push_back({upper_case(word), {}});
      word.clear();
      // The first one is the horizontal one, or what it was projected from is inside it.
      const std::string& keyword = open.back().keyword;
      const bool is_geographic =
          is_one_of(keyword, {"GEOGCS", "GEOGCRS", "GEODCRS", "GEOGRAPHICCRS", "GEODETICCRS"});
      if (!found && (is_geographic || is_one_of(keyword, {"PROJCS", "PROJCRS", "PROJECTEDCRS"}))) {
        found = Crs{.epsg = 0, .is_geographic = is_geographic, .is_given = true};
        depth_of_found = open.size();
      }
    } else if (c == ',' || c == ']' || c == ')') {
      if (!open.empty()) open.back().values.push_back(word);
      word.clear();
      if (c == ',' || open.empty()) continue;
      const Node& node = open.back();
      if (found && open.size() == depth_of_found + 1 && is_one_of(node.keyword, {"AUTHORITY", "ID"}) &&
          node.values.size() >= 2 && upper_case(node.values[0]) == "EPSG") {
        found->epsg = number_of(node.values[1]).value_or(0);
      }
      const bool is_own_unit = open.size() == depth_of_found + 1 && node.keyword == "UNIT";
      if (found && (is_own_unit || node.keyword == "LENGTHUNIT") && node.values.size() >= 2) {
        is_in_metres = is_in_metres && real_number_of(node.values[1]) == 1;
      }
      if (found && found->is_geographic && gives_other_unit(open, depth_of_found))
        found->is_not_in_degrees = true;
      if (found && open.size() == depth_of_found && found->epsg == 0 &&
          (found->is_geographic || is_in_metres)) {
        found->epsg = number_of_known_name(node.values[0]);
      }
      open.pop_back();
      if (found && open.size() + 1 == depth_of_found) return found;
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      word += c;
    }
  }
  return found;
}

}  // namespace

std::string Crs::name() const {
  return epsg > 0 ? "EPSG:" + std::to_string(epsg) : "";
}

Crs crs_of_epsg(int number) {
  const auto has = [&](const Numbers& numbers) { return numbers.has(number); };
  const bool is_geographic = std::any_of(kGeographic.begin(), kGeographic.end(), has) ||
                             std::any_of(kGeographicWithHeights.begin(), kGeographicWithHeights.end(), has);
  return {.epsg = number,
          .is_geographic = is_geographic,
          .is_given = true,
          .is_not_in_degrees = has_grads(number)};
}

std::optional<Crs> crs_of_name(std::string_view name) {
  std::string text = upper_case(std::string(name));
  // In "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837" and "EPSG:25832+7837" the system of heights is
  // second.
  constexpr std::string_view kCompound = "URN:OGC:DEF:CRS,";
  if (text.starts_with(kCompound)) text.erase(0, kCompound.size());
  text.resize(std::min(text.find_first_of(",+"), text.size()));
  if (text.ends_with("CRS84")) return crs_of_epsg(kWgs84);
  const std::size_t authority = text.rfind("EPSG");
  if (authority == std::string::npos) return {};
  const std::optional<int> number = number_of(std::string_view(text).substr(text.find_last_of(":/") + 1));
  if (!number) return {};
  return crs_of_epsg(*number);
}

std::optional<Crs> crs_of_wkt(std::string_view text) {
  std::optional<Crs> crs = horizontal_system(text);
  if (crs && crs->epsg == 0) crs->wkt = text;
  if (crs && has_grads(crs->epsg)) crs->is_not_in_degrees = true;
  return crs;
}

std::optional<Crs> crs_of_geokeys(std::span<const std::uint16_t> keys, std::string_view texts) {
  constexpr std::uint16_t kModelType = 1024;
  constexpr std::uint16_t kCitation = 1026;
  constexpr std::uint16_t kGeodeticSystem = 2048;
  constexpr std::uint16_t kGeodeticCitation = 2049;
  constexpr std::uint16_t kAngularUnit = 2054;
  constexpr std::uint16_t kRadian = 9101;
  constexpr std::uint16_t kDegree = 9102;
  constexpr std::uint16_t kGon = 9106;  // those between are minutes, seconds and grads
  constexpr std::uint16_t kProjectedSystem = 3072;
  constexpr std::uint16_t kProjectedCitation = 3073;
  constexpr std::uint16_t kLengthUnit = 3076;
  constexpr std::uint16_t kMetre = 9001;
  constexpr std::uint16_t kUserDefined = 32767;
  constexpr std::uint16_t kTexts = 34737;
  std::map<std::uint16_t, std::uint16_t> numbers;       // by key
  std::map<std::uint16_t, std::string_view> citations;  // likewise
  for (std::size_t k = 4; k + 4 <= keys.size(); k += 4) {
    const auto [key, place, count, value] = std::array{keys[k], keys[k + 1], keys[k + 2], keys[k + 3]};
    if (place == 0) numbers[key] = value;
    if (place == kTexts && value < texts.size()) citations[key] = texts.substr(value, count);
  }
  const std::uint16_t model = numbers[kModelType];
  const std::uint16_t geodetic = numbers[kGeodeticSystem];
  const std::uint16_t projected = numbers[kProjectedSystem];
  const bool is_geographic = model == 2 || (model == 0 && projected == 0 && geodetic != 0);
  if (!is_geographic && model != 1 && projected == 0) return {};
  const std::uint16_t number = is_geographic ? geodetic : projected;
  const std::uint16_t angle = numbers[kAngularUnit];
  const bool is_not_in_degrees =
      is_geographic && (has_grads(number) || (angle >= kRadian && angle <= kGon && angle != kDegree));
  if (number != 0 && number != kUserDefined) {
    return Crs{.epsg = number,
               .is_geographic = is_geographic,
               .is_given = true,
               .is_not_in_degrees = is_not_in_degrees};
  }
  // A system of that name in feet is another one.
  const bool is_in_metres = !numbers.contains(kLengthUnit) || numbers[kLengthUnit] == kMetre;
  for (const std::uint16_t key : {is_geographic ? kGeodeticCitation : kProjectedCitation, kCitation}) {
    std::string_view name = citations[key];
    name = name.substr(0, name.find_first_of(std::string_view("|\0", 2)));
    // Esri's programs write "PCS Name = WGS_1984_UTM_Zone_32N".
    Crs known = crs_of_epsg(number_of_known_name(name.substr(name.rfind('=') + 1)));
    known.is_not_in_degrees = is_not_in_degrees;
    if (known.epsg > 0 && known.is_geographic == is_geographic && (is_geographic || is_in_metres))
      return known;
  }
  return Crs{
      .epsg = 0, .is_geographic = is_geographic, .is_given = true, .is_not_in_degrees = is_not_in_degrees};
}

}  // namespace polylidar::tool
