#include <iostream>

#include "commands.hpp"
#include "switchyard/io/read.hpp"
#include "switchyard/io/write.hpp"

namespace switchyard::cli {

void AddConvertCommand(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand("convert", "Write a problem in another format");
  command->footer("Example: switchyard convert problem.mps.gz problem.cbf");
  auto from = std::make_shared<std::string>();
  auto to = std::make_shared<std::string>();
  command->add_option("IN", *from, "The file to read; - is standard input")->required();
  command->add_option("OUT", *to, "The file to write, its format by its ending")->required();
  command->callback([from, to, &code] {
    std::vector<std::string> notes;
    ReadOptions reading;
    reading.notes = &notes;
    const auto program = ReadProgram(*from, reading);
    WriteOptions writing;
    writing.notes = &notes;
    WriteProgram(*program, *to, writing);
    for (const std::string& note : notes) std::cerr << "note: " << note << '\n';
    code = kAnswered;
  });
}

}  // namespace switchyard::cli
