#include "io/step/part21.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "io/step/step_units.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

std::string file_of(const std::string& data) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('it''s; "
         "ENDSEC;','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" +
         data + "\nENDSEC;\nEND-ISO-10303-21;\n";
}

class Part21 : public ::testing::Test {
 protected:
  std::string path(const std::string& text) { return folder_.write("a.stp", text); }
  std::string refusal(const std::string& text) {
    return test::refusal(folder_, [&] { Part21File(path(text)); });
  }

  test::InputFolder folder_;
};

TEST_F(Part21, ReadsValuesOfAllKinds) {
  const Part21File file(
      path(file_of("/* #7=A(); */ #12 = B_C1 ( 'it''s' , -1.5E+2,\n 3., .MILLI. , $, *, (1,(2,3),()), "
                   "LENGTH_MEASURE(2.54), #99, \"0AF\" ) ;\n#99=D();")));
  ASSERT_EQ(file.size(), 2u);
  const StepEntity entity = *file.find(12);
  EXPECT_EQ(entity.type(), "B_C1");
  EXPECT_FALSE(entity.is_complex());
  const StepValues values = entity.own("B_C1", 0);
  EXPECT_EQ(values.size(), 10u);
  EXPECT_EQ(values[0].text(), "it's");
  EXPECT_EQ(values[1].number(), -150);
  EXPECT_EQ(values[2].small_integer(), 3);
  EXPECT_EQ(values[3].word(), "MILLI");
  EXPECT_TRUE(values[4].is_omitted());
  EXPECT_TRUE(values[5].is_omitted());
  EXPECT_EQ(values[4].text(), "");
  EXPECT_EQ(values[6].list().size(), 3u);
  EXPECT_EQ(values[6].list()[1].list()[1].number(), 3);
  EXPECT_TRUE(values[7].is_record("LENGTH_MEASURE"));
  EXPECT_EQ(values[7].number(), 2.54);
  EXPECT_EQ(values[8].entity().type(), "D");
  EXPECT_EQ(entity.own("B_C1", 6)[0].list()[0].number(), 1);
  EXPECT_FALSE(file.find(7));
}

TEST_F(Part21, ReadsComplexInstances) {
  const Part21File file(
      path(file_of("#5=(BOUNDED_CURVE() B_SPLINE_CURVE(2,(#1,#2)) REPRESENTATION_ITEM('nose '));")));
  const StepEntity entity = *file.find(5);
  EXPECT_TRUE(entity.is_complex());
  EXPECT_TRUE(entity.is("B_SPLINE_CURVE"));
  EXPECT_FALSE(entity.is("LINE"));
  EXPECT_EQ(entity.own("B_SPLINE_CURVE", 1)[0].number(), 2) << "the record has no inherited parameters";
  EXPECT_EQ(entity.name(), "nose");
  EXPECT_EQ(entity.title(), "BOUNDED_CURVE #5");
}

TEST_F(Part21, ReadsOtherSectionsAndAByteOrderMark) {
  const Part21File file(path(
      "\xef\xbb\xbf/* x */ISO-10303-21;HEADER;ENDSEC;ANCHOR;<a>=#1;ENDSEC;DATA('x',('y'));#1=A('b');ENDSEC;"
      "DATA;#2=A('NONE');ENDSEC;END-ISO-10303-21;rest"));
  EXPECT_EQ(file.size(), 2u);
  EXPECT_EQ(file.find(1)->name(), "b");
  EXPECT_EQ(file.find(2)->name(), "");
}

TEST_F(Part21, NamesLineAndEntityOfDamage) {
  const auto said = [&](const std::string& data, const std::string& expected) {
    const std::string text = refusal(file_of(data));
    EXPECT_NE(text.find(expected), std::string::npos) << text;
  };
  said("#1=A();\n#2=B(1;\n", "a.stp:9: #2: ')' is expected, but ';' is written");
  said("#1=A('x);\n", "a.stp:8: #1: a text does not end");
  said("#1=A(/* );", "#1: a comment does not end");
  said("#1=A(1..5);", "#1: '1..5' is not a number of double precision");
  said("#1=A(1e999);", "'1e999' is not a number");
  said("#1=A(nan);", "'(' is expected");
  said("#1=A(1,);", "#1: a parameter is expected, but ')' is written");
  said("#1=A(.T);", "'.' is expected");
  said("#1=();#2=(());", "#2: the type of an entity is expected");
  said("#1=A();#1=B();", "a.stp:8: #1: occurs twice");
  said("#99999999999999999999=A();", "the number of an entity is larger than");
  said("#x=A();", "a number is expected after '#'");
  said("#1 A();", "'=' is expected, but 'A' is written");
  said("A();", "an entity '#number=' or ENDSEC is expected");
  said("#1=A" + std::string(100, '(') + std::string(100, ')') + ";", "#1: lists are nested deeper than 32");
  EXPECT_NE(refusal("solid x\n").find("a.stp:1: does not begin with ISO-10303-21"), std::string::npos);
  EXPECT_NE(refusal("").find("does not begin with ISO-10303-21"), std::string::npos);
  EXPECT_NE(refusal("ISO-10303-21;HEADER;").find("a section does not end with ENDSEC"), std::string::npos);
  EXPECT_NE(
      refusal("ISO-10303-21;DATA;ENDSEC;").find("a section is expected, but the end of the file is written"),
      std::string::npos);
  EXPECT_NE(refusal("ISO-10303-21;DATA;#1=A();").find("but the end of the file is written"),
            std::string::npos);
}

TEST_F(Part21, RefusesValuesOfAnotherKind) {
  const Part21File file(path(file_of("#1=A('x',1.5,#2,(1),.U.);")));
  const StepValues values = file.find(1)->own("A", 0);
  const auto said = [&](const auto& use) { return test::refusal(folder_, use); };
  EXPECT_NE(
      said([&] { (void)values[0].number(); }).find("a.stp:8: A #1: a number is expected as a parameter"),
      std::string::npos);
  EXPECT_NE(said([&] { (void)values[1].small_integer(); }).find("an integer is expected"), std::string::npos);
  EXPECT_NE(said([&] { (void)values[1].text(); }).find("a text is expected"), std::string::npos);
  EXPECT_NE(said([&] { (void)values[2].entity(); }).find("A #1: refers to #2, which is not in the file"),
            std::string::npos);
  EXPECT_NE(said([&] { (void)values[1].list(); }).find("a list is expected"), std::string::npos);
  EXPECT_NE(said([&] { (void)values[4].flag(); }).find(".T. or .F. is expected"), std::string::npos);
  EXPECT_NE(said([&] { (void)values[1].word(); }).find("a word such as .T. is expected"), std::string::npos);
  EXPECT_NE(said([&] { (void)values[5].number(); }).find("has too few parameters"), std::string::npos);
}

TEST(Part21Text, DecodesCharacters) {
  EXPECT_EQ(text_of_part21("a''b\\\\c"), "a'b\\c");
  EXPECT_EQ(text_of_part21("Fl\\X2\\00FC\\X0\\gel"), "Fl\xc3\xbcgel");
  EXPECT_EQ(text_of_part21("\\X2\\7FFC5F62\\X0\\!"), "\xe7\xbf\xbc\xe5\xbd\xa2!");
  EXPECT_EQ(text_of_part21("\\X2\\D83DDE00\\X0\\"), "\xf0\x9f\x98\x80");
  EXPECT_EQ(text_of_part21("\\X4\\0001F600\\X0\\"), "\xf0\x9f\x98\x80");
  EXPECT_EQ(text_of_part21("\\X2\\D83D\\X0\\x\\X2\\DE00\\X0\\"), "\xef\xbf\xbdx\xef\xbf\xbd");
  EXPECT_EQ(text_of_part21("\\X2\\D83D0041\\X0\\"),
            "\xef\xbf\xbd"
            "A");
  EXPECT_EQ(text_of_part21("\\X\\E9\\S\\i\\PA\\"), "\xc3\xa9\xc3\xa9");
  EXPECT_EQ(text_of_part21("a\\N\\b\nc"), "a bc");
  EXPECT_EQ(text_of_part21("C:\\temp\\X2\\00"), "C:\\temp00")
      << "of a directive without end the rest is kept";
  EXPECT_EQ(text_of_part21("\\"), "\\");
}

class StepUnit : public Part21 {
 protected:
  StepUnits units(const std::string& length, const std::string& angle = "SI_UNIT($,.RADIAN.)") {
    const Part21File file(
        path(file_of("#1=(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#2,#3)) "
                     "REPRESENTATION_CONTEXT('',''));#2=(LENGTH_UNIT() NAMED_UNIT(*) " +
                     length + ");#3=(NAMED_UNIT(*) PLANE_ANGLE_UNIT() " + angle +
                     ");#4=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.54),#5);"
                     "#5=(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.CENTI.,.METRE.));"
                     "#6=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.01745329252),#7);"
                     "#7=(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.));"
                     "#8=(LENGTH_MEASURE_WITH_UNIT() MEASURE_WITH_UNIT(LENGTH_MEASURE(3.),#2));"
                     "#9=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.),#5);")));
    return units_of(*file.find(1));
  }
};

TEST_F(StepUnit, AreNamedByTheirSize) {
  EXPECT_EQ(units("SI_UNIT(.MILLI.,.METRE.)"), (StepUnits{"mm", 1e-3, 1}));
  EXPECT_EQ(units("SI_UNIT($,.METRE.)"), (StepUnits{"m", 1, 1}));
  EXPECT_EQ(units("SI_UNIT(.KILO.,.METRE.)").length, "km");
  EXPECT_EQ(units("SI_UNIT(.MICRO.,.METRE.)").length, "micron");
  const StepUnits inch = units("CONVERSION_BASED_UNIT('INCH',#4)");
  EXPECT_EQ(inch.length, "inch");
  EXPECT_NEAR(inch.metres, 0.0254, 1e-17);
  EXPECT_EQ(units("SI_UNIT(.PICO.,.METRE.)"), (StepUnits{"1e-12 m", 1e-12, 1}));
}

TEST_F(StepUnit, OfAnglesAreRadiansOrDegrees) {
  EXPECT_EQ(units("SI_UNIT($,.METRE.)", "CONVERSION_BASED_UNIT('DEGREES',#6)").radians,
            std::numbers::pi / 180)
      << "ten digits mean the exact degree";
}

TEST_F(StepUnit, AreRefusedWhereTheyMakeNoSense) {
  const auto said = [&](const std::string& length) { return test::refusal(folder_, [&] { units(length); }); };
  EXPECT_NE(said("CONVERSION_BASED_UNIT('X',#8)").find("is defined by itself"), std::string::npos);
  EXPECT_NE(said("CONVERSION_BASED_UNIT('X',#9)").find("has no positive length"), std::string::npos);
  EXPECT_NE(said("SI_UNIT(.MILI.,.METRE.)").find("LENGTH_UNIT #2: 'MILI' is not a prefix"),
            std::string::npos);
  EXPECT_NE(said("CONVERSION_BASED_UNIT('X')").find("has too few parameters"), std::string::npos);
}

}  // namespace
}  // namespace quadloop::io
