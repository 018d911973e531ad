# Writes one C++ source that holds the text of every layout file: cmake -DFILES=a;b -DOUTPUT=x.cpp -P this
set(code "#include \"parser/layout_texts.h\"\n\nnamespace plash {\n\nstd::vector<std::string_view> layout_texts()\n{\n    return {\n")
foreach(file IN LISTS FILES)
    file(READ ${file} text)
    string(APPEND code "        R\"layout(${text})layout\",\n")
endforeach()
string(APPEND code "    };\n}\n\n} // namespace plash\n")
file(WRITE ${OUTPUT} "${code}")
