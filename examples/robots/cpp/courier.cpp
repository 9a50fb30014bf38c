// A courier in a corridor of three stations, driven by a tree that was learned in another world.
//
//     btc learn examples/delivery_small.bt -o learned
//     btc compile learned/learned.bt --tree learned --emit btcpp_history -o learned/history.hpp
//     cmake -S examples/robots/cpp -B build -DTREE=$PWD/learned && cmake --build build
//     build/courier learned/learned.xml

#include "history.hpp"

#include <behaviortree_cpp/bt_factory.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

// The corridor, and the robot in it.
struct Corridor {
    const std::map<std::string, int> stations = {{"A", 0}, {"C", 3}, {"B", 6}};
    int ticks = 0;
    int position = 2;
    int battery = 100;
    int delivered = 0;
    bool carrying = false;

    // What the tree asks: what held when the tick began.
    bool carrying_package = false;
    bool battery_low = false;

    void beginTick()
    {
        ++ticks;
        battery -= 3;
        carrying_package = carrying;
        battery_low = battery <= 25;
    }

    BT::NodeStatus ended(const char* behavior, const std::string& station, BT::NodeStatus status)
    {
        std::printf("tick %2d  %s(%s) %s, battery %d %%\n", ticks, behavior, station.c_str(),
                    BT::toStr(status).c_str(), battery);
        return status;
    }
};

// A step towards a station in each tick.
class Goto : public BT::StatefulActionNode {
public:
    Goto(const std::string& name, const BT::NodeConfig& config, Corridor* corridor)
        : StatefulActionNode(name, config), corridor_(corridor)
    {
    }

    static BT::PortsList providedPorts() { return {BT::InputPort<std::string>("target")}; }

    BT::NodeStatus onStart() override { return onRunning(); }

    BT::NodeStatus onRunning() override
    {
        const auto target = getInput<std::string>("target").value();
        const int place = corridor_->stations.at(target);
        corridor_->position += (place > corridor_->position) - (place < corridor_->position);
        if (corridor_->position != place) {
            return BT::NodeStatus::RUNNING;
        }
        if (target == "A") {
            corridor_->carrying = true;
        } else if (target == "B" && corridor_->carrying) {
            corridor_->carrying = false;
            ++corridor_->delivered;
        }
        return corridor_->ended("goto", target, BT::NodeStatus::SUCCESS);
    }

    void onHalted() override {}

private:
    Corridor* corridor_;
};

// Fills the battery at a station, which takes three ticks.
class Dock : public BT::StatefulActionNode {
public:
    Dock(const std::string& name, const BT::NodeConfig& config, Corridor* corridor)
        : StatefulActionNode(name, config), corridor_(corridor)
    {
    }

    static BT::PortsList providedPorts() { return {BT::InputPort<std::string>("station")}; }

    BT::NodeStatus onStart() override
    {
        docked_ = 0;
        return onRunning();
    }

    BT::NodeStatus onRunning() override
    {
        const auto station = getInput<std::string>("station").value();
        if (corridor_->position != corridor_->stations.at(station)) {
            return corridor_->ended("dock", station, BT::NodeStatus::FAILURE);
        }
        if (++docked_ < 3) {
            return BT::NodeStatus::RUNNING;
        }
        corridor_->battery = 100;
        return corridor_->ended("dock", station, BT::NodeStatus::SUCCESS);
    }

    void onHalted() override {}

private:
    Corridor* corridor_;
    int docked_ = 0;
};

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fprintf(stderr, "usage: courier TREE.xml\n");
        return 2;
    }
    Corridor corridor;
    const auto answer = [](bool holds) {
        return holds ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
    };

    BT::BehaviorTreeFactory factory;
    factory.registerSimpleCondition("carrying_package", [&](BT::TreeNode&) {
        return answer(corridor.carrying_package);
    });
    factory.registerSimpleCondition("battery_low", [&](BT::TreeNode&) {
        return answer(corridor.battery_low);
    });
    factory.registerNodeType<Goto>("goto", &corridor);
    factory.registerNodeType<Dock>("dock", &corridor);
    History history(factory);

    // With a folder: BehaviorTree.CPP does not find a bare file name.
    auto tree = factory.createTreeFromFile(std::filesystem::absolute(argv[1]));
    history.watch(tree);

    auto next = std::chrono::steady_clock::now();
    while (corridor.delivered < 4 && corridor.battery > 0) {
        corridor.beginTick();
        history.beginTick();
        tree.tickExactlyOnce();
        // On a robot: every 100 ms, as the file says.
        std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
    }
    std::printf("%d packages, battery %d %%\n", corridor.delivered, corridor.battery);
    return corridor.delivered == 4 ? 0 : 1;
}
