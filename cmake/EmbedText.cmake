# Writes a C++ source that defines pneuma::detail::<NAME> with the text of a file.
#   cmake -DINPUT=<text> -DOUTPUT=<.cpp> -DNAME=<constant> -DHEADER=<"module/header.h"> -P EmbedText.cmake
file(READ "${INPUT}" text)
string(FIND "${text}" ")text\"" end)
if(NOT end EQUAL -1)
  message(FATAL_ERROR "${INPUT} holds the mark that ends a text in C++: )text\"")
endif()
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"

namespace pneuma::detail {

const std::string_view ${NAME} = R\"text(${text})text\";

}  // namespace pneuma::detail
")
