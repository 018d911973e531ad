# cmake -DFOLDER=third_party/uplot -DOUTPUT=report_assets.cpp -P embed_assets.cmake
# Writes the files of the plot library as string constants.
set(code "#include \"app/report_assets.h\"\n\nnamespace plash {\n\n")
foreach(pair "uplot_script|uPlot.iife.min.js" "uplot_style|uPlot.min.css" "uplot_licence|LICENSE")
    string(REPLACE "|" ";" pair ${pair})
    list(GET pair 0 name)
    list(GET pair 1 file)
    file(READ "${FOLDER}/${file}" text)
    string(APPEND code "const std::string_view ${name} = R\"asset(${text})asset\";\n\n")
endforeach()
string(APPEND code "} // namespace plash\n")
file(WRITE "${OUTPUT}" "${code}")
