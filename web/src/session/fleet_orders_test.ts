import { describe, expect, it } from 'vitest';
import { begin, settled } from '../testing/fake_session';
import { FleetOrders } from './fleet_orders';

describe('orders to the fleet', () => {
  it('Drones that were chosen are named, also where they are all there are: one marked failed may be among them', async () => {
    const { session, sent, editor } = begin();
    const orders = new FleetOrders(session, editor);
    editor.selectDrones([0, 1]);
    orders.toSelected('resume');
    orders.to('resume', 'all');
    await settled();
    expect(sent('resume')).toMatchObject([{ drones: ['d1', 'd2'] }, { drones: 'all' }]);
  });

  it('Nobody is sent to a place whom nobody chose', async () => {
    const { session, sent, editor } = begin();
    const orders = new FleetOrders(session, editor);
    orders.goTo([1, 2]);
    await settled();
    expect(sent('go_to')).toEqual([]);
    expect(session.notices.value.map((notice) => notice.text)).toEqual([
      'Go to sends the selected drones, and none is: select drones first.',
    ]);
    editor.selectDrones([1]);
    orders.goTo([1, 2]);
    await settled();
    expect(sent('go_to')).toMatchObject([{ drones: ['d2'], place_m: [1, 2] }]);
  });
});
