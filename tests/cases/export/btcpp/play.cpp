// Reads a job from standard input, plays it with BehaviorTree.CPP, and prints what the trees did.
//
// A job has the leaves of the files, each a condition or a behaviour of some position, with its id and its ports; and
// plays, each a file with what its robot meets. All in JSON.

#include "history.hpp"

#include <behaviortree_cpp/bt_factory.h>
#include <behaviortree_cpp/contrib/json.hpp>
#include <behaviortree_cpp/utils/timer_queue.h>

#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

using Json = nlohmann::json;
using Ports = std::map<std::string, std::string>;

// A tick of the world.
constexpr std::chrono::milliseconds TICK{100};

// The leaves of a program.
struct Leaves {
    // The position of a leaf by its id and its ports.
    std::map<std::pair<std::string, Ports>, std::size_t> positions;
    // Whether an id is one of behaviours, and its ports.
    std::map<std::string, std::pair<bool, std::set<std::string>>> ids;

    explicit Leaves(const Json& leaves)
    {
        for (const auto& leaf : leaves) {
            const auto id = leaf[2].get<std::string>();
            const auto ports = leaf[3].get<Ports>();
            positions[{id, ports}] = leaf[1].get<std::size_t>();
            auto& known = ids[id];
            known.first = leaf[0].get<bool>();
            for (const auto& port : ports) {
                known.second.insert(port.first);
            }
        }
    }

    std::size_t position(const BT::TreeNode& node) const
    {
        const auto& given = node.config().input_ports;
        return positions.at({node.registrationName(), Ports(given.begin(), given.end())});
    }
};

// What the robot meets in a play.
struct Stage {
    const Leaves& leaves;
    std::string answers;
    bool steady;
    std::string values;
    std::size_t call = 0;
    std::vector<std::size_t> calls;

    BT::NodeStatus holds(const BT::TreeNode& node) const
    {
        const bool holds = values.at(leaves.position(node)) == '1';
        return holds ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
    }

    BT::NodeStatus act(const BT::TreeNode& node)
    {
        const auto behavior = leaves.position(node);
        char answer = answers[call++ % answers.size()];
        calls.push_back(behavior);
        if (steady && behavior % 2 == 0 && answer == 'F') {
            answer = 'S';
        }
        return answer == 'S'   ? BT::NodeStatus::SUCCESS
               : answer == 'F' ? BT::NodeStatus::FAILURE
                               : BT::NodeStatus::RUNNING;
    }
};

// A behaviour that answers as its stage says.
class Action : public BT::StatefulActionNode {
public:
    Action(const std::string& name, const BT::NodeConfig& config, Stage* stage)
        : StatefulActionNode(name, config), stage_(stage)
    {
    }

    BT::NodeStatus onStart() override { return stage_->act(*this); }
    BT::NodeStatus onRunning() override { return stage_->act(*this); }
    void onHalted() override {}

private:
    Stage* stage_;
};

// A tree with what its robot meets, and what it has done.
class Run {
public:
    Run(const Json& play, const Leaves& leaves)
        : valuations_(play["valuations"].get<std::vector<std::string>>()),
          stage_{leaves, play["answers"], play["steady"], {}, 0, {}}
    {
        if (play["remembers"].get<bool>()) {
            history_ = std::make_unique<History>(factory_);
        }
        for (const auto& [id, known] : leaves.ids) {
            enroll(id, known.first, known.second);
        }
        tree_ = factory_.createTreeFromText(play["file"]);
        if (history_) {
            history_->watch(tree_);
        }
    }

    bool done() const { return done_.size() == valuations_.size(); }

    void tick()
    {
        stage_.values = valuations_[done_.size()];
        stage_.calls.clear();
        if (history_) {
            history_->beginTick();
        }
        if (!done_.empty()) {
            BT::TimerClock::advance(TICK);
        }
        const auto status = tree_.tickExactlyOnce();
        done_.push_back({stage_.calls, BT::toStr(status).substr(0, 1)});
    }

    Json answer() const { return done_; }

private:
    void enroll(const std::string& id, bool acts, const std::set<std::string>& names)
    {
        if (history_ && (id == "done" || id == "failed")) {
            return;
        }
        BT::PortsList ports;
        for (const auto& name : names) {
            ports.insert(BT::InputPort<std::string>(name));
        }
        if (acts) {
            factory_.registerBuilder(
                {BT::NodeType::ACTION, id, ports, {}},
                [this](const std::string& name, const BT::NodeConfig& config) {
                    return std::make_unique<Action>(name, config, &stage_);
                });
        } else {
            const auto asked = [this](BT::TreeNode& node) { return stage_.holds(node); };
            factory_.registerSimpleCondition(id, asked, ports);
        }
    }

    std::vector<std::string> valuations_;
    Stage stage_;
    BT::BehaviorTreeFactory factory_;
    std::unique_ptr<History> history_;
    BT::Tree tree_;
    Json done_ = Json::array();
};

int main()
{
    const auto job = Json::parse(std::cin);
    const Leaves leaves(job["leaves"]);
    Json answers = Json::array();
    for (const auto& play : job["plays"]) {
        Run run(play, leaves);
        while (!run.done()) {
            run.tick();
        }
        answers.push_back(run.answer());
    }
    std::cout << Json{{"plays", answers}} << '\n';
}
