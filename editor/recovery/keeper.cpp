#include "editor/recovery/keeper.h"

#include "renderer/base/error.h"

namespace lamplighter {

void Keeper::start(std::filesystem::path root, int process, Journal::Clock clock,
                   const Document& document) {
  root_ = std::move(root);
  journal_ = std::make_unique<Journal>(root_, process, std::move(clock));
  journal_->begin(document);
  look();
}

void Keeper::look() { found_ = findRecoverable(root_); }

void Keeper::opened(const Document& document) {
  if (journal_) journal_->begin(document);
}

template <typename Write>
std::string Keeper::tried(Write write) {
  if (!journal_) return {};
  try {
    write(*journal_);
    return {};
  } catch (const InputError& e) {
    return std::string("The journal is not complete: ") + e.what();
  }
}

std::string Keeper::committed(const Document& document, const std::string& label) {
  return tried([&](Journal& j) { j.record(document, label); });
}

std::string Keeper::saving() {
  return tried([](Journal& j) { j.saving(); });
}

std::string Keeper::saved(const Document& document) {
  return tried([&](Journal& j) { j.saved(document); });
}

void Keeper::adopt(Recovered recovered) {
  if (journal_) journal_->adopt(std::move(recovered));
  look();
}

void Keeper::close() {
  if (journal_) journal_->close();
}

}  // namespace lamplighter
