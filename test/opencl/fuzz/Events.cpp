/// Events that the program sets, lists of events, and callbacks.

#include "Sequence.h"

#include <algorithm>

namespace vorion::test {

namespace {

void CL_CALLBACK nothing(cl_event /*E*/, cl_int /*S*/, void * /*D*/) {}
void CL_CALLBACK gone(cl_mem /*Buffer*/, void * /*Data*/) {}

} // namespace

Sequence::WaitList Sequence::waitList() {
  WaitList W;
  if (!Events.empty() && chance(40))
    for (unsigned I = below(3) + 1; I > 0; --I)
      W.Events.push_back(pick(Events));
  W.Count = cl_uint(W.Events.size());
  if (chance(2))
    W.Count = W.Events.empty() ? 1 : 0;
  W.List = W.Events.empty() ? nullptr : W.Events.data();
  return W;
}

void Sequence::userEvent() {
  cl_int Status = CL_SUCCESS;
  if (Unset.empty() || chance(40)) {
    const cl_event Made = clCreateUserEvent(pick(Contexts), &Status);
    if (check("clCreateUserEvent", Status, {CL_INVALID_CONTEXT}) && Made) {
      Events.push_back(Made);
      Unset.push_back(Made);
      ++Pending;
    }
    return;
  }
  const std::size_t I = below(unsigned(Unset.size()));
  const cl_int Value = any<cl_int>({CL_COMPLETE, CL_COMPLETE, -1, -5000, 1});
  Status = clSetUserEventStatus(Unset[I], Value);
  check("clSetUserEventStatus", Status,
        {CL_INVALID_EVENT, CL_INVALID_VALUE, CL_INVALID_OPERATION});
  if (Status == CL_SUCCESS) {
    Unset.erase(Unset.begin() + std::ptrdiff_t(I));
    --Pending;
  }
  const cl_event Other = pick(Events);
  if (chance(10) && std::ranges::find(Unset, Other) == Unset.end())
    check("clSetUserEventStatus", clSetUserEventStatus(Other, CL_COMPLETE),
          {CL_INVALID_EVENT, CL_INVALID_VALUE, CL_INVALID_OPERATION});
}

void Sequence::callback() {
  if (chance(70))
    check("clSetEventCallback",
          clSetEventCallback(pick(Events),
                             any<cl_int>({CL_COMPLETE, CL_RUNNING, CL_SUBMITTED,
                                          CL_QUEUED, -1}),
                             chance(95) ? nothing : nullptr, nullptr),
          {CL_INVALID_EVENT, CL_INVALID_VALUE});
  else
    check("clSetMemObjectDestructorCallback",
          clSetMemObjectDestructorCallback(
              pick(Buffers), chance(95) ? gone : nullptr, nullptr),
          {CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE});
}

} // namespace vorion::test
