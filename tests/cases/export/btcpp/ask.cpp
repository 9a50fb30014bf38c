// Tries with BehaviorTree.CPP what the documentation says of it, and prints what happened, in JSON.

#include <behaviortree_cpp/bt_factory.h>
#include <behaviortree_cpp/contrib/json.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>
#include <string>
#include <vector>

using Json = nlohmann::json;
using Status = BT::NodeStatus;

// A behaviour that answers as it is told.
class Told : public BT::StatefulActionNode {
public:
    using Answer = std::function<Status()>;

    Told(const std::string& name, const BT::NodeConfig& config, Answer answer)
        : StatefulActionNode(name, config), answer_(std::move(answer))
    {
    }

    static BT::PortsList providedPorts() { return {}; }
    Status onStart() override { return answer_(); }
    Status onRunning() override { return answer_(); }
    void onHalted() override {}

private:
    Answer answer_;
};

std::string file(const std::string& inside)
{
    return R"(<root BTCPP_format="4"><BehaviorTree ID="tried">)" + inside + "</BehaviorTree></root>";
}

// How many behaviours of a sequence with memory each of two calls ticks, and its answer.
Json stepping(const std::string& text, const std::function<Status(BT::Tree&)>& tick)
{
    int calls = 0;
    const Told::Answer answer = [&] {
        ++calls;
        return Status::SUCCESS;
    };
    BT::BehaviorTreeFactory factory;
    factory.registerNodeType<Told>("go", answer);
    factory.registerNodeType<Told>("rest", answer);
    auto tree = factory.createTreeFromText(text);
    Json counts = Json::array();
    for (int i = 0; i < 2; ++i) {
        calls = 0;
        const auto status = tick(tree);
        counts.push_back({calls, BT::toStr(status)});
    }
    return counts;
}

// What a tree that succeeds and fails in turn answers under a root that never ends.
Json endless()
{
    bool succeeds = false;
    const Told::Answer answer = [&] {
        succeeds = !succeeds;
        return succeeds ? Status::SUCCESS : Status::FAILURE;
    };
    BT::BehaviorTreeFactory factory;
    factory.registerNodeType<Told>("go", answer);
    auto tree = factory.createTreeFromText(file(
        "<KeepRunningUntilFailure><ForceSuccess><go/></ForceSuccess></KeepRunningUntilFailure>"));
    std::set<std::string> answers;
    for (int i = 0; i < 20; ++i) {
        answers.insert(BT::toStr(tree.tickExactlyOnce()));
    }
    return answers;
}

// What a tree says that leaves a behaviour that runs for another one.
std::string leaving(bool exception)
{
    BT::ReactiveFallback::EnableException(exception);
    BT::ReactiveSequence::EnableException(exception);
    bool asked = false;
    BT::BehaviorTreeFactory factory;
    factory.registerSimpleCondition("low", [&](BT::TreeNode&) {
        asked = !asked;
        return asked ? Status::SUCCESS : Status::FAILURE;
    });
    const Told::Answer answer = [] { return Status::RUNNING; };
    factory.registerNodeType<Told>("go", answer);
    factory.registerNodeType<Told>("rest", answer);
    auto tree = factory.createTreeFromText(file(
        "<ReactiveFallback><ReactiveSequence><low/><go/></ReactiveSequence><rest/></ReactiveFallback>"));
    try {
        tree.tickExactlyOnce();
        return BT::toStr(tree.tickExactlyOnce());
    } catch (const BT::LogicError& error) {
        const std::string what = error.what();
        return what.substr(0, what.find('\n'));
    }
}

bool loads(const std::filesystem::path& path)
{
    try {
        const auto tree = BT::BehaviorTreeFactory().createTreeFromFile(path);
        return tree.rootNode() != nullptr;
    } catch (const std::exception&) {
        return false;
    }
}

int main()
{
    const auto job = Json::parse(std::cin);
    const auto text = job["file"].get<std::string>();
    Json answer;
    answer["tickExactlyOnce"] = stepping(text, [](BT::Tree& tree) { return tree.tickExactlyOnce(); });
    answer["tickOnce"] = stepping(text, [](BT::Tree& tree) { return tree.tickOnce(); });
    answer["tickWhileRunning"] = stepping(text, [](BT::Tree& tree) { return tree.tickWhileRunning(); });
    answer["endless"] = endless();
    answer["ids"] = BT::BehaviorTreeFactory().builtinNodes();
    answer["leaving, with an exception"] = leaving(true);
    answer["leaving"] = leaving(false);

    std::filesystem::current_path(job["folder"].get<std::string>());
    std::ofstream("tree.xml") << file("<AlwaysSuccess/>");
    answer["bare"] = loads("tree.xml");
    answer["in a folder"] = loads("./tree.xml");
    std::cout << answer << '\n';
}
