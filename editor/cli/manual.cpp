#include "editor/cli/manual.h"

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

namespace lamplighter::cli {
namespace {

// Escapes text for roff: backslashes and leading dots would be commands, hyphens another character.
std::string roff(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool startsLine = i == 0 || text[i - 1] == '\n';
    if (startsLine && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\') {
      out += "\\e";
    } else if (text[i] == '-') {
      out += "\\-";
    } else {
      out += text[i];
    }
  }
  return out;
}

// Escapes vertical bars, which would end a table cell.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

bool isFlag(const CLI::Option& o) { return o.get_type_size() == 0; }

// "-o,--output FILE"
std::string usageOf(const CLI::Option& o) {
  std::string name = o.get_positional() ? o.get_name(true) : o.get_name(false, true);
  for (size_t at = 0; (at = name.find(',', at)) != std::string::npos; at += 2)
    name.replace(at, 1, ", ");
  if (isFlag(o) || o.get_positional()) return name;
  return name + " " + o.get_type_name();
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); });
}

std::string synopsis(const CLI::App& app, const std::string& name) {
  std::string text = name;
  bool hasOptions = false;
  for (const CLI::Option* o : app.get_options()) {
    if (o->get_positional()) continue;
    if (o->get_required())
      text += " " + usageOf(*o).substr(0, usageOf(*o).find(',')) + " " + o->get_type_name();
    else
      hasOptions = true;
  }
  if (hasOptions) text += " [options]";
  for (const CLI::Option* o : app.get_options()) {
    if (!o->get_positional()) continue;
    const std::string positional = o->get_name(true);
    text += o->get_required() ? " " + positional : " [" + positional + "]";
  }
  return text;
}

void addOptions(std::string& out, const CLI::App& app) {
  for (const CLI::Option* o : app.get_options()) {
    std::string help = o->get_description();
    if (!o->get_default_str().empty() && !isFlag(*o)) help += " [" + o->get_default_str() + "]";
    out += fmt::format(".TP\n.B {}\n{}\n", roff(usageOf(*o)), roff(help));
  }
}

}  // namespace

std::string manPage(const CLI::App& app) {
  std::string out = fmt::format(
      ".\\\" Written by `lamplighter manual --man`.\n.TH LAMPLIGHTER 1 \"\" \"Lamplighter\" \"User "
      "Commands\"\n.SH NAME\nlamplighter \\- lighting editor for level designers\n.SH SYNOPSIS\n"
      ".B {}\n",
      roff(synopsis(app, "lamplighter")));
  for (const CLI::App* sub : commandsOf(app))
    out += fmt::format(".br\n.B {}\n", roff(synopsis(*sub, "lamplighter " + sub->get_name())));
  out +=
      ".SH DESCRIPTION\nOpens a glTF level, places and tunes lights, and shows soft shadows and "
      "several bounces of indirect light while they are dragged. Without a command the editor "
      "opens a window; the commands need none.\n.SH OPTIONS\n";
  addOptions(out, app);
  out += ".SH COMMANDS\n";
  for (const CLI::App* sub : commandsOf(app)) {
    out += fmt::format(".SS {}\n{}.\n", roff(synopsis(*sub, sub->get_name())),
                       roff(sub->get_description()));
    addOptions(out, *sub);
    std::string footer = roff(sub->get_footer());
    for (size_t at = 0; (at = footer.find('\n', at)) != std::string::npos; at += 5)
      footer.replace(at, 1, "\n.br\n");
    if (!footer.empty()) out += ".PP\n" + footer + "\n";
  }
  out +=
      ".SH EXIT STATUS\n.TP\n.B 0\nGood.\n.TP\n.B 1\nA check failed.\n.TP\n.B 2\nWrong usage or "
      "invalid input: one line on standard error says what is wrong and what to do.\n.TP\n.B "
      "130\nStopped by Ctrl+C; finished work is kept (bake).\n.SH FILES\nShaders and scenes lie "
      "in\n.IR share/lamplighter\nbeside the program's folder.\n";
  return out;
}

std::string flagTables(const CLI::App& app) {
  std::string out =
      "# Flags\n\nWritten by `lamplighter manual --markdown`; [cli.md](cli.md) explains them in "
      "full.\n";
  const auto add = [&](const CLI::App& of, const std::string& name) {
    out += fmt::format("\n## {}\n\n{}.\n\n| flag | default | |\n| --- | --- | --- |\n", name,
                       of.get_description());
    for (const CLI::Option* o : of.get_options())
      out += fmt::format("| `{}` | {} | {} |\n", cell(usageOf(*o)),
                         isFlag(*o) ? "" : cell(o->get_default_str()), cell(o->get_description()));
  };
  add(app, "lamplighter");
  for (const CLI::App* sub : commandsOf(app)) add(*sub, "lamplighter " + sub->get_name());
  return out;
}

}  // namespace lamplighter::cli
