// What `splat doctor` says of values that a test cannot bring about, and of
// variables. Broken environments are in test/render/doctor.test.
#include "doctor/Host.h"
#include "doctor/Variables.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace vorion::splat;

namespace {

constexpr uint64_t MiB = uint64_t{1} << 20;

TEST(Doctor, AFullDiskIsAFault) {
  EXPECT_EQ(examineDisk("/work", 100 * MiB).State, DiagnosisState::Well);
  const Diagnosis Full = examineDisk("/work", 100 * MiB - 1);
  EXPECT_EQ(Full.State, DiagnosisState::Fault);
  EXPECT_EQ(Full.Text, "/work has 99 MiB free, expected 100 MiB");
  EXPECT_FALSE(Full.Fix.empty());
}

TEST(Doctor, LittleMemoryIsAFault) {
  EXPECT_EQ(examineMemory(1024 * MiB).State, DiagnosisState::Well);
  const Diagnosis Little = examineMemory(1024 * MiB - 1);
  EXPECT_EQ(Little.State, DiagnosisState::Fault);
  EXPECT_FALSE(Little.Fix.empty());
}

TEST(Doctor, VariablesOfOthersAreNotLookedAt) {
  EXPECT_TRUE(examineVariables(std::vector<std::string>{
                                   "HOME=/home/a", "PATH=VORION_SET", "VORION"})
                  .empty());
}

TEST(Doctor, AVariableThatIsReadIsANote) {
  const Diagnoses Found =
      examineVariables(std::vector<std::string>{"VORION_CONFIG=scaled"});
  ASSERT_EQ(Found.size(), 1U);
  EXPECT_EQ(Found[0].State, DiagnosisState::Note);
  EXPECT_EQ(Found[0].Text, "VORION_CONFIG=scaled selects the machine, by "
                           "name or JSON file");
}

TEST(Doctor, AVariableThatNobodyReadsIsAFault) {
  const Diagnoses Found = examineVariables(
      std::vector<std::string>{"VORION_CONFG=scaled", "VORION_PANCAKES=2"});
  ASSERT_EQ(Found.size(), 2U);
  EXPECT_EQ(Found[0].State, DiagnosisState::Fault);
  EXPECT_EQ(Found[0].Fix, "unset VORION_CONFG, or did you mean VORION_CONFIG?");
  EXPECT_EQ(Found[1].State, DiagnosisState::Fault);
  EXPECT_EQ(Found[1].Fix, "unset VORION_PANCAKES");
}

TEST(Doctor, OneRowAVariable) {
  for (const KnownVariable &A : knownVariables())
    for (const KnownVariable &B : knownVariables())
      EXPECT_TRUE(&A == &B || std::string(A.Name) != B.Name) << A.Name;
}

} // namespace
