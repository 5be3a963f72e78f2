#include "switchyard/symbolic/variable_names.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

// The blocks of all programs by their first ids. Those of programs that ended are swept out when
// there are twice as many as were left by the last sweep, so that each is looked at a few times.
class Registry {
 public:
  void Add(Variable::Id first, const std::shared_ptr<const NameBlock>& names) {
    const std::lock_guard lock(mutex_);
    if (blocks_.size() >= sweep_at_) {
      std::erase_if(blocks_, [](const auto& entry) { return entry.second.expired(); });
      sweep_at_ = std::max<std::size_t>(64, 2 * blocks_.size());
    }
    blocks_.insert_or_assign(blocks_.end(), first, names);
  }

  std::string Find(Variable::Id id) {
    std::shared_ptr<const NameBlock> names;
    Variable::Id first = 0;
    {
      const std::lock_guard lock(mutex_);
      const auto behind = blocks_.upper_bound(id);
      if (behind == blocks_.begin()) return {};
      first = std::prev(behind)->first;
      names = std::prev(behind)->second.lock();
    }
    return names != nullptr && id - first < names->size()
               ? names->Name(static_cast<int>(id - first))
               : std::string();
  }

 private:
  std::mutex mutex_;
  std::map<Variable::Id, std::weak_ptr<const NameBlock>> blocks_;
  std::size_t sweep_at_ = 64;
};

// Never destroyed: programs may end, and be made, after main.
Registry& TheRegistry() {
  static Registry& registry = *new Registry;
  return registry;
}

}  // namespace

std::string NameOf(Variable variable) {
  std::string name = TheRegistry().Find(variable.get_id());
  return name.empty() ? Text("v", variable.get_id()) : name;
}

void RegisterNames(Variable::Id first, const std::shared_ptr<const NameBlock>& names) {
  TheRegistry().Add(first, names);
}

}  // namespace switchyard
