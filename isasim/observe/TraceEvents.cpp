#include "observe/TraceEvents.h"

#include "vorion/support/GrowingFile.h"
#include "vorion/support/Json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

namespace {

std::string jsonName(std::string_view Text) {
  return jsonText(nlohmann::json(Text));
}

} // namespace

void TraceEvents::event(const std::string &Json) {
  if (Events++ == 0)
    append(Out,
           "{{\"otherData\": {{\"format\": \"vorion-timeline 1\", \"unit\": "
           "{}}},\n\"traceEvents\": [\n",
           jsonName("1 us = " + Unit));
  else
    append(Out, ",\n");
  append(Out, "{}", Json);
}

void TraceEvents::nameProcess(unsigned Process, std::string_view Name) {
  event(fmt::format("{{\"ph\": \"M\", \"name\": \"process_name\", \"pid\": {}, "
                    "\"args\": {{\"name\": {}}}}}",
                    Process, jsonName(Name)));
}

void TraceEvents::nameThread(unsigned Process, unsigned Thread,
                             std::string_view Name) {
  event(fmt::format("{{\"ph\": \"M\", \"name\": \"thread_name\", \"pid\": {}, "
                    "\"tid\": {}, \"args\": {{\"name\": {}}}}}",
                    Process, threadId(Thread), jsonName(Name)));
}

void TraceEvents::slice(unsigned Process, unsigned Thread,
                        std::string_view Name, uint64_t From, uint64_t To,
                        std::string_view Args) {
  event(fmt::format("{{\"ph\": \"X\", \"name\": {}, \"pid\": {}, \"tid\": {}, "
                    "\"ts\": {}, \"dur\": {}{}{}}}",
                    jsonName(Name), Process, threadId(Thread), From, To - From,
                    Args.empty() ? "" : ", \"args\": ", Args));
}

void TraceEvents::counter(unsigned Process, std::string_view Name,
                          uint64_t From, double Value) {
  event(fmt::format("{{\"ph\": \"C\", \"name\": {}, \"pid\": {}, \"ts\": {}, "
                    "\"args\": {{\"value\": {}}}}}",
                    jsonName(Name), Process, From, Value));
}

void TraceEvents::complete() {
  std::fflush(Out);
  const long End = std::ftell(Out);
  append(Out, "\n]}}\n");
  std::fflush(Out);
  std::fseek(Out, End, SEEK_SET);
}

} // namespace vorion::isasim
