"""What a worker does first."""

import asyncio

from sketchtree.studio.crew import Hand


def test_what_the_tree_wears_goes_before_pictures_of_what_it_might_wear():
    async def answered_in_order():
        hand, order = Hand("side", None, lambda number, value: None), []
        try:
            asked = {name: hand.ask("picture", "template", name)[1] for name in ("english_oak", "silver_birch", "scots_pine", "no such")}
            asked["texture"] = hand.ask("texture", "no such", "color")[1]
            for name, answer in asked.items():
                answer.add_done_callback(lambda _, name=name: order.append(name))
            await asyncio.wait(asked.values(), timeout=120)
        finally:
            hand.end()
        return order

    order = asyncio.run(answered_in_order())
    assert len(order) == 5 and order.index("texture") <= 1  # one picture may have been begun
