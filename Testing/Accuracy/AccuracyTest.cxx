// Every case of the table by every method that can do it. The lines that it prints are those of
// Documentation/Accuracy.md.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdio>

#include "AccuracyCases.h"
#include "AccuracyMethods.h"

namespace lambert::testing {
namespace {

struct Pairing {
  const AccuracyCase* asked;
  const AccuracyMethod* method;
};

std::vector<Pairing> Pairings() {
  std::vector<Pairing> pairings;
  for (const AccuracyCase& asked : AccuracyCases()) {
    for (const AccuracyMethod& method : AccuracyMethods()) {
      if ((asked.needs & method.cannot) == 0) pairings.push_back({&asked, &method});
    }
  }
  return pairings;
}

std::string NameOf(const ::testing::TestParamInfo<Pairing>& info) {
  std::string name = info.param.asked->name + " by " + info.param.method->name;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

class KnownAnswers : public ::testing::TestWithParam<Pairing> {};

TEST_P(KnownAnswers, AreFound) {
  const AccuracyCase& asked = *GetParam().asked;
  const AccuracyMethod& method = *GetParam().method;
  const double ofTheScene = asked.modelError + (method.isSmooth ? asked.smoothError : 0);
  const std::vector<Finding> findings = method.find(asked);
  ASSERT_EQ(findings.size(), asked.quantities.size());
  for (size_t i = 0; i < findings.size(); ++i) {
    const Quantity& q = asked.quantities[i];
    const double size = std::abs(q.truth - q.offset);
    EXPECT_LE(findings[i].tolerance, method.largest * size) << "so long a bar says nothing";
    const double tolerance = findings[i].tolerance + ofTheScene * size + q.lastDigit;
    std::printf("| %s, %s | %s | %.10g | %.6g | %.1e |\n", asked.name.c_str(), q.label.c_str(),
                method.name, q.truth, findings[i].value, tolerance);
    EXPECT_NEAR(findings[i].value, q.truth, tolerance) << q.label;
  }
}
INSTANTIATE_TEST_SUITE_P(Accuracy, KnownAnswers, ::testing::ValuesIn(Pairings()), NameOf);

}  // namespace
}  // namespace lambert::testing
